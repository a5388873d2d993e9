// highlight.glsl: the specular term: N.H or R.V to the power of the shininess.

float highlight(vec3 a, vec3 b, float shininess) {
    return safe_pow(dot(a, b), shininess);
}
