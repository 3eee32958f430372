#!/bin/sh
# Makes template.yaml again: trunks, then each limb, by rotations; then the hands are drawn together.
# usage: data/holds/full_nelson/pose.sh [RETARGET [OUT]]
set -e
here=$(dirname "$0")
"${1:-$here/../../../build/release/retarget}" pose --rest \
  --stature a=1.84 --stature b=1.72 --root b=0,0.94,0.06,2,0,0 --root a=0,0.905,-0.20,-8,0,0 \
  --rotate b/waist=4,0,0 --rotate b/chest=-2,0,0 --rotate b/neck=24,0,0 --rotate b/head=16,0,0 \
  --rotate b/left_clavicle=0,10,22 --rotate b/right_clavicle=0,-10,-22 --rotate a/waist=-4,0,0 \
  --rotate a/chest=16,0,0 --rotate a/neck=-2,0,0 --rotate a/head=-6,0,0 \
  --rotate a/left_clavicle=0,-6,4 --rotate a/right_clavicle=0,6,-4 \
  --rotate b/left_hip=-15.7,4.4,3.0 --rotate b/left_knee=27.0,0.0,-0.0 \
  --rotate b/left_ankle=-4.4,1.5,-2.9 --rotate b/right_hip=-12.8,-4.8,-2.5 \
  --rotate b/right_knee=26.7,-0.0,-0.0 --rotate b/right_ankle=-7.1,-2.9,2.7 \
  --rotate a/left_hip=-23.2,10.8,12.8 --rotate a/left_knee=58.7,-0.0,-0.0 \
  --rotate a/left_ankle=-18.2,-8.7,-6.0 --rotate a/right_hip=-11.0,-11.0,-12.5 \
  --rotate a/right_knee=56.3,0.0,-0.0 --rotate a/right_ankle=-27.8,6.2,7.8 \
  --rotate b/left_shoulder=-45.4,33.5,2.8 --rotate b/left_elbow=-0.0,-81.1,-0.0 \
  --rotate b/left_wrist=-0.0,-18.4,22.1 --rotate b/right_shoulder=-39.8,-32.5,-0.0 \
  --rotate b/right_elbow=0.0,81.0,-0.0 --rotate b/right_wrist=0.0,5.9,-32.9 \
  --rotate a/left_shoulder=-56.1,-52.9,-37.2 --rotate a/left_elbow=18.2,-121.0,34.9 \
  --rotate a/left_wrist=0.0,-43.7,-10.7 --rotate a/right_shoulder=-54.3,51.9,37.4 \
  --rotate a/right_elbow=16.1,123.0,-31.8 --rotate a/right_wrist=0.0,50.5,16.1 --pin a/root \
  --pin b/root --settle --drag a/right_hand=-0.02,1.56,-0.06 \
  --drag a/left_hand=0.02,1.56,-0.06 --drag a/right_hand=-0.02,1.56,-0.06 \
  --hold a/right_hand=a/left_wrist \
  --name "full nelson" \
  --description "a stands close behind b, both arms under b's armpits, hands clasped behind b's neck." \
  --tags "hold,standing,from behind,wrestling" \
  --force --out "${2:-$here/template.yaml}"
