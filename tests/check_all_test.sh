#!/usr/bin/env bash
# Tests scripts/check-all with stand-ins for its checks. usage: check_all_test.sh CHECK_ALL
set -euo pipefail
check_all=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

complain() {
  echo "$1"
  failures=$((failures + 1))
}

# exits CODE -- OPTIONS...: runs the stand-ins with these options; what was printed is in $report.
exits() {
  local expected=$1 code=0
  shift 2
  rm -rf "$folder/logs" "$folder/ran"
  report=$("$check_all" --checks "$folder/checks" --logs "$folder/logs" "$@" 2>&1) || code=$?
  ((code == expected)) || complain "exit code $code instead of $expected for '$*': $report"
}

ran() {
  local all
  touch "$folder/ran"
  all=$(tr '\n' ' ' <"$folder/ran")
  [[ ${all% } == "$1" ]] || complain "ran '${all% }' instead of '$1'"
}

# line NAME RESULT: there is one line for the check, with its result, its minutes and its log file.
line() {
  local found
  found=$(grep --count --extended-regexp "^$1 +$2 +[0-9]+\.[0-9] min +$folder/logs/$1\.log\$" <<<"$report") || true
  ((found == 1)) || complain "$found lines for '$1 $2' in: $report"
}

cat >"$folder/checks" <<END
# comment

good   echo good >>$folder/ran; echo said by good; echo error of good >&2
bad    echo bad >>$folder/ran; false; echo beyond >>$folder/ran
pipe   echo pipe >>$folder/ran; false | true
last   cat; echo last >>$folder/ran
END

# Continues after a failure; a command ends at its first failure, also inside a pipe, and cannot wait for input.
exits 1 --
ran 'good bad pipe last'
line good passed
line bad failed
line pipe failed
line last passed
(($(wc -l <<<"$report") == 4)) || complain "not a line for each check: $report"
[[ $(cat "$folder/logs/good.log") == $'said by good\nerror of good' ]] || complain "the log of good is incomplete"

exits 0 -- --only last,good
ran 'good last'
exits 1 -- --skip good,pipe
ran 'bad last'
exits 0 -- --only good,bad --skip bad
ran 'good'

# A list runs nothing.
exits 0 -- --list --only bad,good
ran ''
(($(wc -l <<<"$report") == 2)) || complain "not a line for each check: $report"

# What nobody could mean runs nothing.
for wrong in '--only god' '--skip god' '--only' '--verbose' '--verbose yes' 'good' '--only good --skip good'; do
  # shellcheck disable=SC2086  # the words of the options
  exits 2 -- $wrong
  ran ''
done

# The real checks have names and commands that the shell can read, and scripts that exist.
while read -r name command; do
  [[ -n $command ]] || complain "the check $name has no command"
  bash -n -c "$command" || complain "the shell cannot read the command of $name"
  while read -r script; do
    [[ -r $(dirname "$check_all")/../$script ]] || complain "the check $name runs $script, which does not exist"
  done < <(grep --only-matching 'scripts/[a-z.-]*' <<<"$command")
done < <("$check_all" --list)

((failures == 0))
