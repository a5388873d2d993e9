// panel: flat triangles over the picture, with letters from an atlas.

attribute vec2 a_Position; // pixels of the window, from its upper left corner
attribute vec2 a_TexCoord;
attribute vec4 a_Color;

uniform vec2 u_Size; // of the window

varying vec2 v_TexCoord;
varying vec4 v_Color;

void main() {
    vec2 clip = 2.0 * a_Position / u_Size - 1.0;
    gl_Position = vec4(clip.x, -clip.y, 0.0, 1.0);
    v_TexCoord = a_TexCoord;
    v_Color = a_Color;
}
