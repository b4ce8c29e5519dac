#!/bin/sh
# Runs a test of glint_add_image_test(): makes a picture and compares it with its baseline.
#
#     glintImageTest.sh GLINT BASELINE FOLDER FILE ENDING NAME WORDS COMMAND... [OPTION OF DIFF]...
#
# WORDS is the number of words of COMMAND. The results for `glint diff --run FOLDER` are left in FOLDER.
set -u
glint=$1 baseline=$2 folder=$3 file=$4 ending=$5 name=$6 words=$7
shift 7
actual=$folder/actual/$file$ending
kept=$folder/baseline/$file$ending
difference=$folder/difference/$file.png
result=$folder/result/$file.json
log=$folder/log/$file.txt
for part in actual baseline difference result log status; do
  mkdir -p "$folder/$part" || exit 2
done
rm -f "$actual" "$kept" "$difference" "$result" "$log"

# Records the progress of the test: if it is killed, the last record remains.
reached() { echo "$*" >"$folder/status/$file.txt"; }
reached started

# Runs the first `words` arguments as a command.
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
command "$@" >"$log" 2>&1
status=$?
cat "$log"
if [ "$status" -ne 0 ]; then
  reached command "$status"
  echo "image test $name: the command that makes the picture ended with status $status" >&2
  exit 2
fi
if [ ! -f "$actual" ]; then
  reached nothing
  echo "image test $name: the command has not written $actual" >&2
  exit 2
fi
shift "$words"

if [ "${GLINT_UPDATE_BASELINES:-0}" = 1 ]; then
  said=$("$glint" diff "$baseline" "$actual" "$@" --json "$result" --update 2>&1)
  status=$?
  echo "$said"
  # ctest hides a test's output; replaced baselines are also printed to ctest's own stderr, but not if
  # that is a file, in which ctest would overwrite it.
  parent=/proc/$PPID
  if [ "$status" -eq 0 ] && [ "$(cat "$parent/comm" 2>/dev/null)" = ctest ] &&
    [ ! -f "$parent/fd/2" ]; then
    echo "$said" | grep 'the baseline' 2>/dev/null >>"$parent/fd/2"
  fi
  [ "$status" -eq 0 ] && cp "$baseline" "$kept" && reached updated || reached compared "$status"
  exit "$status"
fi
"$glint" diff "$baseline" "$actual" "$@" --output "$difference" --json "$result"
status=$?
reached compared "$status"
# The baseline may be that of a driver, or one of several: the result names the one used.
used=$(sed -n 's/^  "a": "\(.*\)",$/\1/p' "$result" 2>/dev/null)
[ ! -f "$used" ] || cp "$used" "$kept"
if [ "$status" -ne 0 ]; then
  echo "image test $name: the picture is $actual, the baseline $baseline"
  [ ! -f "$difference" ] || echo "image test $name: the difference is $difference"
  echo "image test $name: to accept it: GLINT_UPDATE_BASELINES=1 ctest -R '^$name\$'"
  echo "image test $name: a page of all: glint diff --run '$folder' --html report.html"
fi
exit "$status"
