#!/bin/sh
# Refines the cow and the founding paper's torus; run by `make demo`.
set -eu

carvel=${CARVEL:-target/release/carvel}
out=${OUT:-out}
cow=assets/spot/spot_control_mesh.obj
torus=assets/torus_4x4.obj
mkdir -p "$out"

echo "The cow: 188 vertices, 180 faces of 3, 4 and 5 sides, three levels of three schemes"
for scheme in doo-sabin three-point quartic; do
    "$carvel" subdivide "$cow" -o "$out/cow_$scheme.obj" --scheme "$scheme" --levels 3 \
        --preview "$out/cow_$scheme.png"
done
"$carvel" preview "$cow" "$out/cow_doo-sabin.obj" "$out/cow_three-point.obj" \
    "$out/cow_quartic.obj" -o "$out/cow_schemes.png" --size 600x560

echo
echo "The torus of the founding paper, three-point scheme"
for level in 0 1 2 3; do
    "$carvel" subdivide "$torus" -o "$out/torus_$level.obj" --levels "$level" --quiet
done
"$carvel" subdivide "$torus" -o "$out/torus_3.obj" --levels 3 --json --preview "$out/torus_3.png" |
    awk -F'[:,]' '
        BEGIN { printf "%5s %9s %9s %9s\n", "level", "vertices", "edges", "faces" }
        /"counts"/ { inside = 1 }
        /\]/ { inside = 0 }
        inside && /"level"/ { level = $2 + 0 }
        inside && /"vertices"/ { vertices = $2 + 0 }
        inside && /"edges"/ { edges = $2 + 0 }
        inside && /"faces"/ { printf "%5d %9d %9d %9d\n", level, vertices, edges, $2 + 0 }'
"$carvel" preview "$out/torus_0.obj" "$out/torus_1.obj" "$out/torus_2.obj" "$out/torus_3.obj" \
    -o "$out/torus_levels.png" --size 500x360 --wireframe overlay --shading flat --up z --elevation 35

echo
echo "Written to $out/: meshes (*.obj) and pictures (*.png); look at cow_schemes.png first."
