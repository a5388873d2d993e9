// surface.vert: depth for surface.frag.

attribute vec4 a_Position;
uniform mat4 u_ClipFromObject;
varying float v_Depth;

void main() {
    gl_Position = u_ClipFromObject * a_Position;
    v_Depth = gl_Position.w; // of a perspective: -z in eye coordinates
}
