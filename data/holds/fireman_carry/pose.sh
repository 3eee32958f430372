#!/bin/sh
# The operations that made template.yaml: pose.sh RETARGET OUT.yaml
# a stands bent, b lies across his shoulders; the last operations part them, bring hand and wrist
# together and close the hold.
"$1" pose --rest \
  --stature a=1.84 --root a=0,0.965,0,10,0,0 \
  --rotate a/waist=7.0,0.0,2.0 \
  --rotate a/chest=5.0,0.0,2.0 \
  --rotate a/neck=8.0,0.0,2.0 \
  --rotate a/head=-14.0,0.0,0.0 \
  --rotate a/left_hip=-30.1,-0.2,1.7 \
  --rotate a/left_knee=44.4,0.0,0.0 \
  --rotate a/left_ankle=-14.1,5.2,-3.4 \
  --rotate a/right_hip=-32.9,0.3,-2.4 \
  --rotate a/right_knee=44.4,0.0,0.0 \
  --rotate a/right_ankle=-11.4,-5.1,4.0 \
  --rotate a/right_clavicle=0.0,0.0,6.0 \
  --rotate a/right_shoulder=0.3,2.5,32.5 \
  --rotate a/right_elbow=-56.9,81.8,67.2 \
  --rotate a/right_wrist=0.0,4.3,53.1 \
  --rotate a/left_clavicle=0.0,-0.0,-4.0 \
  --rotate a/left_shoulder=20.1,-8.8,-55.5 \
  --rotate a/left_elbow=-32.4,-80.5,-29.3 \
  --rotate a/left_wrist=0.0,18.9,7.3 \
  --stature b=1.74 --root b=-0.235,1.62,-0.035,54.3,77.6,-54.3 \
  --rotate b/waist=18.0,0.0,8.0 \
  --rotate b/chest=19.0,0.0,6.0 \
  --rotate b/neck=8.0,0.0,0.0 \
  --rotate b/right_hip=-68.9,-84.8,12.3 \
  --rotate b/right_knee=42.6,0.0,-0.0 \
  --rotate b/right_ankle=33.3,26.3,7.0 \
  --rotate b/left_hip=-72.7,22.6,2.4 \
  --rotate b/left_knee=38.7,0.0,0.0 \
  --rotate b/left_ankle=21.0,-14.0,-4.8 \
  --rotate b/right_clavicle=0.0,14.0,-0.0 \
  --rotate b/right_shoulder=25.3,7.3,5.8 \
  --rotate b/right_elbow=-27.0,68.4,19.0 \
  --rotate b/right_wrist=-0.0,-5.4,-10.9 \
  --rotate b/left_shoulder=-52.4,-76.5,-13.8 \
  --rotate b/left_elbow=23.3,-29.8,6.3 \
  --rotate b/left_wrist=0.0,6.9,-9.0 \
  --option root=off --settle --settle \
  --drag a/right_hand=-0.22,1.17,0.46 --drag b/right_wrist=-0.16,1.22,0.43 \
  --hold a/right_hand=b/right_wrist --settle \
  --leader b=partner \
  --supports a=left_ankle,left_toe,right_ankle,right_toe --supports b= \
  --name "fireman's carry" --tags 'carry,walking,over the shoulders' \
  --description "b lies across a's shoulders; a's right arm hooks b's right leg and holds the wrist." \
  --out "$2" --force
