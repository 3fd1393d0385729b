# models_test.sh GENERATOR MODELS FOLDER: the generator writes the files of MODELS, byte for byte, and no others.
set -euo pipefail
rm -rf "$3"
mkdir -p "$3"
"$1" "$3"
diff --recursive --brief --exclude=CMakeLists.txt --exclude=generate "$3" "$2"
