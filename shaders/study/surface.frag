// surface.frag: object number and depth of a pixel, for a float framebuffer.

precision highp float;

uniform float u_Object; // from 1
varying float v_Depth;

void main() {
    gl_FragColor = vec4(u_Object, v_Depth, 0.0, 1.0);
}
