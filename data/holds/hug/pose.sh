#!/bin/sh
# The operations that made template.yaml: pose.sh RETARGET OUT.yaml
# a stoops, b stretches up; the last operations part them, bring their hands together and close the
# holds.
"$1" pose --rest \
  --stature a=1.80 --root a=0,0.968,-0.09,9,0,0 \
  --rotate a/waist=7.0,0.0,-2.0 \
  --rotate a/chest=6.0,0.0,-2.0 \
  --rotate a/neck=-6.0,-6.0,-8.0 \
  --rotate a/head=-12.0,-6.0,-6.0 \
  --rotate a/left_hip=-25.1,-0.2,2.6 \
  --rotate a/left_knee=35.1,0.0,0.0 \
  --rotate a/left_ankle=-8.8,7.1,-4.5 \
  --rotate a/right_hip=-18.4,0.0,-2.5 \
  --rotate a/right_knee=32.5,-0.0,0.0 \
  --rotate a/right_ankle=-12.9,-7.0,4.7 \
  --rotate a/right_clavicle=0.0,6.0,-6.0 \
  --rotate a/right_shoulder=14.3,63.6,-32.7 \
  --rotate a/right_elbow=-71.9,59.2,54.1 \
  --rotate a/right_wrist=-0.0,-8.7,24.6 \
  --rotate a/left_clavicle=0.0,-10.0,0.0 \
  --rotate a/left_shoulder=2.4,-54.8,-25.1 \
  --rotate a/left_elbow=-45.9,-72.2,-37.6 \
  --rotate a/left_wrist=-0.0,-21.1,-17.5 \
  --stature b=1.68 --root b=0,0.928,0.34,4,180,0 \
  --rotate b/waist=-1.0,0.0,-2.0 \
  --rotate b/chest=1.0,0.0,-2.0 \
  --rotate b/neck=-4.0,-8.0,-6.0 \
  --rotate b/head=-8.0,-6.0,-6.0 \
  --rotate b/left_hip=-1.1,-0.0,-1.7 \
  --rotate b/left_knee=16.2,0.0,-0.0 \
  --rotate b/left_ankle=-5.0,7.6,-2.5 \
  --rotate b/right_hip=-10.8,0.3,-3.7 \
  --rotate b/right_knee=24.4,0.0,0.0 \
  --rotate b/right_ankle=-3.5,-7.6,2.7 \
  --rotate b/right_clavicle=0.0,6.0,-12.0 \
  --rotate b/right_shoulder=7.2,67.1,-17.8 \
  --rotate b/right_elbow=-78.5,52.5,52.6 \
  --rotate b/right_wrist=-0.0,-24.4,34.0 \
  --rotate b/left_clavicle=0.0,-12.0,2.0 \
  --rotate b/left_shoulder=0.9,-52.7,-29.5 \
  --rotate b/left_elbow=-73.8,-54.5,-49.7 \
  --rotate b/left_wrist=0.0,-27.3,-35.7 \
  --option root=off --settle --drag b/right_hand=-0.02,1.28,-0.15 --drag a/left_hand=0.0,1.17,0.52 \
  --hold a/left_hand=a/right_hand --hold b/right_hand=b/left_hand --settle \
  --supports a=left_ankle,left_toe,right_ankle,right_toe \
  --supports b=left_ankle,left_toe,right_ankle,right_toe \
  --name 'hug' --tags 'standing,face to face' \
  --description "face to face: each one's right arm over the other's left shoulder, hands clasped." \
  --out "$2" --force
