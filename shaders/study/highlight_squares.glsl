// highlight_squares.glsl: lighting/highlight.glsl for the shininess 32, by squaring, without max: NaN
// stays NaN.

float highlight(vec3 a, vec3 b, float shininess) {
    float power = dot(a, b);
    for (int i = 0; i < 5; i++)
        power *= power;
    return power;
}
