// surface.frag: which object a pixel shows, and how far away. Into a framebuffer of floats.

precision highp float;

uniform float u_Object; // its number, from 1
varying float v_Depth;

void main() {
    gl_FragColor = vec4(u_Object, v_Depth, 0.0, 1.0);
}
