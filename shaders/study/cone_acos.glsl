// cone_acos.glsl: lighting/cone.glsl by angles, not cosines.

bool in_cone(float along, float cutoff) {
    return acos(along) <= acos(cutoff);
}
