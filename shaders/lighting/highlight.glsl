// highlight.glsl: the specular term: the cosine of the angle between two unit vectors, N and H or R
// and V, to the power of the shininess.

float highlight(vec3 a, vec3 b, float shininess) {
    return safe_pow(dot(a, b), shininess);
}
