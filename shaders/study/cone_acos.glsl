// cone_acos.glsl: lighting/cone.glsl by the angles themselves.

bool in_cone(float along, float cutoff) {
    return acos(along) <= acos(cutoff);
}
