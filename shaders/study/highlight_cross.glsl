// highlight_cross.glsl: lighting/highlight.glsl by Lagrange's identity, (a.b)^2 = 1 - |a x b|^2 for
// unit vectors. Near the highlight's center the cosine is nearly 1 and the sine small, so that
// low precision still resolves the angle.

float highlight(vec3 a, vec3 b, float shininess) {
    vec3 sine = cross(a, b);
    float square = dot(a, b) > 0.0 ? 1.0 - dot(sine, sine) : 0.0;
    return safe_pow(square, 0.5 * shininess);
}
