// cone.glsl: whether light from a spot arrives, by the cosine of the angle to its axis and that of
// its cutoff.

bool in_cone(float along, float cutoff) {
    return along >= cutoff;
}
