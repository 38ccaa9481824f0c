#!/bin/sh
# Refines the cow, a creased cube and the founding paper's torus; run by `make demo`.
set -eu

carvel=${CARVEL:-target/release/carvel}
out=${OUT:-out}
cow=assets/spot/spot_control_mesh.obj
torus=assets/torus_4x4.obj
cube=assets/cube.obj
mkdir -p "$out"

echo "The cow: 188 vertices, 180 faces of 3, 4 and 5 sides, three levels of five schemes"
for scheme in doo-sabin three-point quartic catmull-clark; do
    "$carvel" subdivide "$cow" -o "$out/cow_$scheme.obj" --scheme "$scheme" --levels 3 \
        --preview "$out/cow_$scheme.png"
done
# STL holds triangles only, which is what Loop's scheme asks for.
"$carvel" subdivide "$cow" -o "$out/cow_triangles.stl" --levels 0 --quiet
"$carvel" subdivide "$out/cow_triangles.stl" -o "$out/cow_loop.obj" --scheme loop --levels 3 \
    --preview "$out/cow_loop.png"
"$carvel" preview "$cow" "$out/cow_doo-sabin.obj" "$out/cow_three-point.obj" \
    "$out/cow_quartic.obj" "$out/cow_catmull-clark.obj" "$out/cow_loop.obj" \
    -o "$out/cow_schemes.png" --size 450x440

echo
echo "A cube with creases around its top and bottom: sharpness 0, 1, 2, 3 and infinite"
cubes=
for sharpness in 0 1 2 3 10; do
    {
        cat "$cube"
        for edge in "0 1" "1 3" "3 2" "2 0" "4 5" "5 7" "7 6" "6 4"; do
            echo "t crease 2/1/0 $edge $sharpness"
        done
    } >"$out/cube_$sharpness.obj"
    "$carvel" subdivide "$out/cube_$sharpness.obj" -o "$out/cube_crease_$sharpness.obj" \
        --scheme catmull-clark --levels 5 --quiet
    cubes="$cubes $out/cube_crease_$sharpness.obj"
done
# The names hold no blanks but those between them.
# shellcheck disable=SC2086
"$carvel" preview $cubes -o "$out/cube_creases.png" --size 400x360 --up z

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
