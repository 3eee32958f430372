#!/bin/sh
# Makes template.yaml again: trunks, then each limb, by rotations; then the figure four is drawn tight.
# usage: data/holds/rear_choke/pose.sh [RETARGET [OUT]]
set -e
here=$(dirname "$0")
"${1:-$here/../../../build/release/retarget}" pose --rest \
  --stature a=1.80 --stature b=1.72 --root b=0,0.905,0.13,-7,0,0 \
  --root a=0.02,0.935,-0.185,-1,0,0 --rotate b/waist=-6,0,0 --rotate b/chest=3,0,0 \
  --rotate b/neck=4,0,0 --rotate b/head=0,0,0 --rotate b/left_clavicle=0,-8,-2 \
  --rotate b/right_clavicle=0,8,4 --rotate a/waist=-1,0,0 --rotate a/chest=8,0,0 \
  --rotate a/neck=-4,-8,12 --rotate a/head=0,-14,6 --rotate a/left_clavicle=0,-12,8 \
  --rotate a/right_clavicle=0,14,-18 --rotate b/left_hip=-18.5,2.3,4.3 \
  --rotate b/left_knee=41.4,0.0,-0.0 --rotate b/left_ankle=-7.0,8.9,-5.4 \
  --rotate b/right_hip=-13.3,-3.4,-3.3 --rotate b/right_knee=42.7,0.0,0.0 \
  --rotate b/right_ankle=-13.4,-8.6,4.9 --rotate a/left_hip=-30.7,13.9,8.1 \
  --rotate a/left_knee=40.5,-0.0,0.0 --rotate a/left_ankle=0.7,-2.7,-3.4 \
  --rotate a/right_hip=-9.2,-14.3,-11.1 --rotate a/right_knee=40.3,0.0,0.0 \
  --rotate a/right_ankle=-20.2,2.6,9.2 --rotate b/left_shoulder=-9.4,-43.0,-46.5 \
  --rotate b/left_elbow=0.0,-130.9,-0.0 --rotate b/left_wrist=0.0,-9.7,2.1 \
  --rotate b/right_shoulder=-11.5,31.5,41.0 --rotate b/right_elbow=0.0,133.2,0.0 \
  --rotate b/right_wrist=-0.0,16.2,-4.2 --rotate a/right_shoulder=-19.1,77.3,5.4 \
  --rotate a/right_elbow=-63.0,76.2,70.5 --rotate a/right_wrist=0.0,12.6,15.2 \
  --rotate a/left_shoulder=-70.1,-68.2,-14.2 --rotate a/left_elbow=11.2,-136.9,30.4 \
  --rotate a/left_wrist=-0.0,-5.1,-35.7 --pin a/root --pin b/root --pin b/head --settle \
  --drag a/left_hand=0.03,1.55,-0.08 --drag a/right_hand=0.245,1.46,0.095 \
  --drag a/left_hand=0.03,1.55,-0.08 --hold a/right_hand=a/left_elbow \
 \
  --name "rear choke" \
  --description "a stands behind b, right forearm under b's chin, right hand in the crook of the left elbow, left hand behind b's head." \
  --tags "hold,standing,from behind,choke,wrestling" \
  --force --out "${2:-$here/template.yaml}"
