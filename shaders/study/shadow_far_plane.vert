// shadow_far_plane.vert: shadow.vert of volumes, which end at infinity, in the camera's projection:
// its far plane cuts them open.

attribute vec4 a_Position; // w = 0: moved to infinity, away from the light
uniform mat4 u_ClipFromObject;
uniform vec3 u_Center; // in object coordinates, near the vertices
uniform vec4 u_Light;  // from there; w = 0: the direction towards it

invariant gl_Position;

void main() {
    vec4 place = a_Position;
    if (place.w == 0.0)
        place.xyz = u_Light.w * (place.xyz - u_Center) - u_Light.xyz;
    gl_Position = u_ClipFromObject * place;
}
