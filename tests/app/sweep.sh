#!/usr/bin/env bash
# Sweeps: pictures with the bits of render --set, a sheet, a table with the error of each difference.
. "$(dirname "$0")/_common.sh"

small=(--size 32x18 --spp 4 -q)
expect 0 "$tyndall" sweep showroom --vary /materials/gold/fuzz=0:0.4:3 "${small[@]}" -o s.png --csv s.csv --each 'e%v.pfm'
for value in 0 0.2 0.4; do
  expect 0 "$tyndall" render showroom --set /materials/gold/fuzz=$value "${small[@]}" -o one.pfm --stats one.json
  cmp -s one.pfm "e$value.pfm" || fail "the picture of $value has other bits than render --set"
  grep -q "^$value,.*,$(json one.json image_hash | tr -d '"')\$" s.csv || fail "the table lacks the hash of $value: $(cat s.csv)"
done
python3 - <<'END' || fail "the table: $(cat s.csv)"
import csv
rows = list(csv.DictReader(open("s.csv")))
number = lambda row, key: float(row[key])
assert [row["value"] for row in rows] == ["0", "0.2", "0.4"]
middle = rows[1]
assert number(middle, "change") == 0 and number(middle, "difference_error") == 0
for row in (rows[0], rows[2]):
    assert abs(number(row, "change") - (number(row, "mean") / number(middle, "mean") - 1)) < 1e-6
    assert 0 < number(row, "difference_error") and 0 < number(row, "change_error")
    assert number(row, "spp") == 4
END
expect 0 "$tyndall" convert s.png -o middle.json
grep -q '"fuzz": 0.2' middle.json || fail 'the sheet does not carry the scene in the middle'

# Two axes, names, types, standard output, one seed.
expect 0 "$tyndall" sweep showroom --vary /materials/gold/type=metal,lambertian --vary /camera/vfov=30:40:2 "${small[@]}" --csv -
same 'rows of two axes' "$(cut -d, -f1,2 out | tr '\n' ' ')" \
  'value,value_2 metal,30 lambertian,30 metal,40 lambertian,40 '
expect 0 "$tyndall" sweep showroom --vary /render/seed=1,2 "${small[@]}" --each '%v.ppm' --gamma2
[ -s 1.ppm ] && [ -s 2.ppm ] || fail 'names of values'

# Of a black picture nothing is a part.
expect 0 "$tyndall" sweep stress-caustic-mirror --set /materials/lamp/radiance=[0,0,0] --vary /camera/vfov=30:40:2 "${small[@]}" --csv -
same 'a change of black' "$(tail -n +2 out | cut -d, -f5,6 | tr '\n' ' ')" ', , '

# The total time is shared.
expect 0 "$tyndall" sweep showroom --vary /camera/vfov=30:40:4 --size 64x36 --total-time 0.4 -q --csv t.csv
python3 -c '
import csv
total = sum(float(row["seconds"]) for row in csv.DictReader(open("t.csv")))
assert 0.2 < total < 4, total' || fail "the total time: $(cat t.csv)"

# Pictures in EXR are kept, and refused if they are of something else.
if has_exr; then
  again=(sweep showroom --vary /materials/gold/fuzz=0:0.4:3 "${small[@]}" --each 'k%v.exr' --csv)
  expect 0 "$tyndall" "${again[@]}" a.csv
  before=$(stat -c %z k0.4.exr)
  rm k0.exr
  expect 0 "$tyndall" "${again[@]}" b.csv
  same 'a picture that was there' "$(stat -c %z k0.4.exr)" "$before"
  same 'the table of a sweep that went on' "$(cut -d, -f10 --complement a.csv)" "$(cut -d, -f10 --complement b.csv)"
  expect 2 "$tyndall" sweep showroom --vary /materials/gold/fuzz=0:0.4:3 --size 32x18 --spp 5 -q --each 'k%v.exr'
  complains k0.exr '4 samples' --fresh
  expect 0 "$tyndall" sweep showroom --vary /materials/gold/fuzz=0:0.4:3 --size 32x18 --spp 5 -q --fresh --each 'k%v.exr'
fi
finish
