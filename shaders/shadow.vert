// shadow.vert: the depths of surfaces, and the volumes that they keep from a light. Both in one
// program, so that equal vertices land at equal depths.

attribute vec4 a_Position; // w = 0: moved to the end, away from the light
uniform mat4 u_ClipFromObject;
uniform vec3 u_Center; // in object coordinates, near the vertices
uniform vec4 u_Light;  // from there; w = 0: the direction towards it
uniform vec4 u_End;    // a plane, from there; (0, 0, 0, 1) is infinity
uniform float u_Near;

// Of a projection without a far plane, less two steps of a depth of 24 bits, so that infinity is
// not clipped. (Everitt and Kilgard, Practical and Robust Stenciled Shadow Volumes, 2002; Lengyel,
// The mechanics of robust stencil shadows, 2002)
#define FARTHEST (1.0 - 2.4e-7)

void main() {
    vec4 place = a_Position;
    if (place.w == 0.0) {
        // Where the line from the light meets the plane. (Blinn, Me and my (fake) shadow, IEEE CG&A
        // 8(1), 1988)
        vec4 from = vec4(place.xyz - u_Center, 1.0);
        place = dot(u_End, u_Light) * from - dot(u_End, from) * u_Light;
        place.xyz += place.w * u_Center;
    }
    gl_Position = u_ClipFromObject * place;
    gl_Position.z = FARTHEST * gl_Position.w - (1.0 + FARTHEST) * u_Near * place.w;
}
