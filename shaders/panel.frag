// panel: a colour, where the atlas is opaque.

// The letters of an atlas are nearer to each other than mediump can tell.
#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform sampler2D u_Atlas; // of texture unit 0

varying vec2 v_TexCoord;
varying vec4 v_Color;

void main() {
    gl_FragColor = vec4(v_Color.rgb, v_Color.a * texture2D(u_Atlas, v_TexCoord).a);
}
