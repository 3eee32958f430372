#!/bin/sh
# Makes template.yaml again: trunks, then each limb, by rotations; then what overlaps is parted.
# usage: data/holds/argentine_backbreaker/pose.sh [RETARGET [OUT]]
set -e
here=$(dirname "$0")
"${1:-$here/../../../build/release/retarget}" pose --rest \
  --stature a=1.88 --stature b=1.70 --root a=0,0.93,0,2,0,0 \
  --root b=0.12,1.65,-0.10,-69.28,69.28,69.28 --turn b=0,0,-8 --rotate a/waist=8,0,0 \
  --rotate a/chest=8,0,0 --rotate a/neck=14,0,0 --rotate a/head=-2,0,0 \
  --rotate a/left_clavicle=0,-4,14 --rotate a/right_clavicle=0,4,-14 --rotate b/waist=-20,0,0 \
  --rotate b/chest=-20,0,0 --rotate b/neck=-6,0,0 --rotate b/head=-4,0,0 \
  --rotate a/left_hip=-34.7,19.7,13.7 --rotate a/left_knee=56.6,-0.0,-0.0 \
  --rotate a/left_ankle=-13.3,-7.9,-5.7 --rotate a/right_hip=-28.4,-18.9,-14.1 \
  --rotate a/right_knee=56.9,-0.0,0.0 --rotate a/right_ankle=-19.7,4.9,8.3 \
  --rotate b/right_hip=16.1,-8.5,-9.5 --rotate b/right_knee=38.0,-0.0,0.0 \
  --rotate b/right_ankle=85.6,3.0,-7.1 --rotate b/left_hip=-14.7,12.5,19.4 \
  --rotate b/left_knee=55.7,-0.0,-0.0 --rotate b/left_ankle=72.3,-6.8,12.5 \
  --rotate a/right_shoulder=142.2,-39.9,37.4 --rotate a/right_elbow=0.0,99.0,-0.0 \
  --rotate a/right_wrist=0.0,67.9,-4.8 --rotate a/left_shoulder=141.8,39.8,-28.6 \
  --rotate a/left_elbow=-0.0,-101.6,-0.0 --rotate a/left_wrist=0.0,-67.0,17.2 \
  --rotate b/right_shoulder=25.3,13.7,-25.4 --rotate b/right_elbow=-0.0,101.4,-0.0 \
  --rotate b/right_wrist=-0.0,-6.1,45.0 --rotate b/left_shoulder=-94.6,17.6,45.5 \
  --rotate b/left_elbow=-0.0,-92.0,-0.0 --rotate b/left_wrist=0.0,46.6,18.0 --pin a/root \
  --pin b/root --settle --drag a/left_hand=0.386,1.53,-0.12 --hold a/right_hand=b/neck --hold a/left_hand=b/right_knee \
  --supports b= --leader b=partner \
  --name "Argentine backbreaker" \
  --description "b lies face up across a's shoulders behind his neck; a's right arm hooks b's neck, his left arm b's right thigh." \
  --tags "hold,carry,lifted,wrestling" \
  --force --out "${2:-$here/template.yaml}"
