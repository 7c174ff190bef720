#!/usr/bin/env bash
# Accepts the pictures that the golden tests draw now, all or those whose test's name matches:
#   tools/accept_goldens.sh [GTEST_FILTER]       for example  tools/accept_goldens.sh '*Show*'
# Look at every picture that it names before you commit it.
# GOLDEN_TEST names another build's test program (default: the preset dev's).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=${GOLDEN_TEST:-$root/build/dev/tests/golden/golden_test}
if [[ -z ${GOLDEN_TEST-} ]]; then
  cmake --build "$root/build/dev" --target golden_test >/dev/null
fi
LIBGL_ALWAYS_SOFTWARE=1 VINDU_ACCEPT_GOLDENS=1 "$program" --gtest_brief=1 --gtest_filter="${1:-*}"
git -C "$root" status --short -- tests/golden
echo "Look at the pictures above; then commit them, or undo with git."
