// cone.glsl: whether a direction is within a spot's cone, from the cosines of its angle to the axis
// and of the cutoff.

bool in_cone(float along, float cutoff) {
    return along >= cutoff;
}
