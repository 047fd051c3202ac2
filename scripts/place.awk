# place.awk: several OBJ models into one, each scaled, turned and moved.
#
#     awk -f place.awk SCALE=1 TURN=x:90 AT=0,0,0 a.obj  SCALE=0.5 TURN= AT=1,0,0 b.obj  > both.obj
#
# Settings stand before the file they are for and hold until set again. SCALE is a number, or three: 1,0.2,1.
# NAME makes the file an object of that name. TURN is a list of turns about
# axes, in degrees, done in order: y:30,x:-90. KEEP drops faces: KEEP=y<0.5 keeps those with a corner
# there, in the model's own coordinates.
BEGIN { first = 0; count = 0; SCALE = 1; AT = "0,0,0"; print "# written by place.awk" }
FNR == 1 {
    if (NAME) print "o " NAME
    split(SCALE, scale, ","); if (scale[2] == "") scale[2] = scale[3] = scale[1]
    first = count; turns = split(TURN, turn, ","); split(AT, at, ",")
    for (i = 1; i <= turns; i++) {
        split(turn[i], t, ":"); axis[i] = t[1]
        c[i] = cos(t[2] * 3.14159265358979 / 180); s[i] = sin(t[2] * 3.14159265358979 / 180)
    }
    limit = KEEP ? substr(KEEP, 3) + 0 : 0; along = index("xyz", substr(KEEP, 1, 1)) + 1
}
$1 == "v" {
    if (KEEP) kept[++count] = substr(KEEP, 2, 1) == "<" ? $along < limit : $along > limit; else count++
    x = $2 * scale[1]; y = $3 * scale[2]; z = $4 * scale[3]
    for (i = 1; i <= turns; i++) {
        if (axis[i] == "x") { p = c[i] * y - s[i] * z; z = s[i] * y + c[i] * z; y = p }
        if (axis[i] == "y") { p = c[i] * z - s[i] * x; x = s[i] * z + c[i] * x; z = p }
        if (axis[i] == "z") { p = c[i] * x - s[i] * y; y = s[i] * x + c[i] * y; x = p }
    }
    printf "v %.9g %.9g %.9g\n", x + at[1], y + at[2], z + at[3]
}
$1 == "f" {
    keep = !KEEP; line = "f"
    for (i = 2; i <= NF; i++) {
        n = $i < 0 ? count + 1 + $i : first + $i
        if (KEEP && kept[n]) keep = 1
        line = line " " n
    }
    if (keep) print line
}
