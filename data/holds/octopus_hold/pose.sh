#!/bin/sh
# Makes template.yaml again: trunks, then each limb, by rotations; then what overlaps is parted.
# usage: data/holds/octopus_hold/pose.sh [RETARGET [OUT]]
set -e
here=$(dirname "$0")
"${1:-$here/../../../build/release/retarget}" pose --rest \
  --stature a=1.70 --stature b=1.84 --root b=0,0.87,-0.12,30,0,0 \
  --root a=0.28,1.305,0.06,-12,-14,-12 --rotate b/waist=18,0,0 --rotate b/chest=14,0,0 \
  --rotate b/neck=6,0,0 --rotate b/head=16,0,0 --rotate b/left_clavicle=0,0,20 \
  --rotate a/waist=-2,6,0 --rotate a/chest=4,6,0 --rotate a/neck=10,-8,6 \
  --rotate a/head=10,-10,4 --rotate a/left_clavicle=0,-12,4 --rotate a/right_clavicle=0,12,-4 \
  --rotate b/left_hip=-69.7,13.9,13.0 --rotate b/left_knee=61.4,0.0,0.0 \
  --rotate b/left_ankle=-9.6,6.3,-12.8 --rotate b/right_hip=-66.0,-13.8,-13.6 \
  --rotate b/right_knee=62.9,0.0,0.0 --rotate b/right_ankle=-14.6,-5.8,14.3 \
  --rotate a/right_hip=-84.4,-16.5,-20.8 --rotate a/right_knee=91.1,0.0,0.0 \
  --rotate a/right_ankle=2.2,151.2,-14.4 --rotate a/left_hip=-8.5,32.7,-4.9 \
  --rotate a/left_knee=50.2,-0.0,0.0 --rotate a/left_ankle=-33.8,116.8,-52.2 \
  --rotate b/left_shoulder=-56.0,57.6,36.8 --rotate b/left_elbow=0.0,-11.5,0.0 \
  --rotate b/left_wrist=0.0,1.4,2.7 --rotate b/right_shoulder=-15.1,30.9,49.9 \
  --rotate b/right_elbow=0.0,89.6,-0.0 --rotate b/right_wrist=-0.0,-23.9,29.6 \
  --rotate a/right_shoulder=24.1,56.3,59.8 --rotate a/right_elbow=-35.2,65.7,24.0 \
  --rotate a/right_wrist=0.0,33.8,48.2 --rotate a/left_shoulder=31.9,-21.1,-38.6 \
  --rotate a/left_elbow=-25.1,-109.1,-38.9 --rotate a/left_wrist=0.0,15.8,8.1 --pin b/root \
  --settle --hold a/left_hand=a/right_wrist --supports a= --leader a=partner \
  --name "octopus hold" \
  --description "a hangs on b, who stands bent forward: right leg over b's neck, left leg hooked round b's left thigh, b's left arm hugged to the chest." \
  --tags "hold,standing,lifted,wrestling" \
  --force --out "${2:-$here/template.yaml}"
