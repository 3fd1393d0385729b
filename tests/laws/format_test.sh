# format_test.sh CLANG_FORMAT ROOT: every source is as .clang-format wants it.
set -euo pipefail
cd "$2"
mapfile -t -d '' sources < <(find bench compare core docs models reference tests \
    \( -name '*.h' -o -name '*.cpp' \) -print0)
((${#sources[@]} > 50)) || { echo "Only ${#sources[@]} sources were found."; exit 1; }
"$1" --dry-run --Werror --ferror-limit=3 "${sources[@]}"
