// highlight_plain.glsl: lighting/highlight.glsl without max: the power of a negative cosine is
// NaN.

float highlight(vec3 a, vec3 b, float shininess) {
    return pow(dot(a, b), shininess);
}
