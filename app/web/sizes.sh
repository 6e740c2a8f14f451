#!/usr/bin/env bash
# sizes.sh: the files of the page in the current folder: their bytes, and those that go over the wire from a server that
# compresses by gzip. Textures are not counted: they are fetched when a scene has them.
for file in index.html isolate.js page.js tyndall_page.*; do
  echo "$file $(wc -c <"$file") $(gzip -9c "$file" | wc -c)"
done | awk '{ print; all += $2; wire += $3 } END { print "all", all, wire }'
