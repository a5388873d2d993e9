// highlight_plain.glsl: lighting/highlight.glsl without max: a negative cosine has no power, and
// what is no number stays none.

float highlight(vec3 a, vec3 b, float shininess) {
    return pow(dot(a, b), shininess);
}
