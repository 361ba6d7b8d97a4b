#!/bin/sh
# sh laptop.sh STUDY DIR
set -e
stickslip study run "$1" --out "$2"
stickslip study status "$1" --out "$2"
