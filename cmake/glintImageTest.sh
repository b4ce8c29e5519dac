#!/bin/sh
# The tests of glint_add_image_test(): makes a picture and compares it with its baseline.
#
#     glintImageTest.sh GLINT BASELINE FOLDER NAME ENDING WORDS COMMAND... [OPTION OF DIFF]...
#
# WORDS is the number of words of COMMAND.
set -u
glint=$1 baseline=$2 folder=$3 name=$4 ending=$5 words=$6
shift 6
actual=$folder/actual/$name$ending
kept=$folder/baseline/$name$ending
difference=$folder/difference/$name.png
result=$folder/result/$name.json
mkdir -p "$folder/actual" "$folder/baseline" "$folder/difference" "$folder/result" || exit 2
rm -f "$actual" "$kept" "$difference" "$result"

# The first `words` arguments.
command() {
  all=$#
  left=$words
  for word; do
    [ "$left" -gt 0 ] || break
    left=$((left - 1))
    set -- "$@" "$word"
  done
  shift "$all"
  "$@"
}
command "$@"
status=$?
if [ "$status" -ne 0 ]; then
  echo "image test $name: the command that makes the picture ended with status $status" >&2
  exit 2
fi
if [ ! -f "$actual" ]; then
  echo "image test $name: the command has not written $actual" >&2
  exit 2
fi
shift "$words"

if [ "${GLINT_UPDATE_BASELINES:-0}" = 1 ]; then
  "$glint" diff "$baseline" "$actual" "$@" --update
  exit
fi
"$glint" diff "$baseline" "$actual" "$@" --output "$difference" --json "$result"
status=$?
# The baseline may be that of a driver: the result says which.
used=$(sed -n 's/^  "a": "\(.*\)",$/\1/p' "$result")
[ ! -f "$used" ] || cp "$used" "$kept"
if [ "$status" -ne 0 ]; then
  echo "image test $name: the picture is $actual, the baseline $baseline"
  [ ! -f "$difference" ] || echo "image test $name: the difference is $difference"
  echo "image test $name: to accept it: GLINT_UPDATE_BASELINES=1 ctest -R '^$name\$'"
fi
exit "$status"
