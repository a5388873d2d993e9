// Diffuse directional light, as one writes it by hand: tests/benchmark/effects_benchmark.c.
attribute vec4 a_Position;
attribute vec3 a_Normal;
uniform mat4 u_ClipFromObject;
uniform mat4 u_EyeFromObject;
varying vec3 v_Normal;
void main() {
    gl_Position = u_ClipFromObject * a_Position;
    v_Normal = vec3(u_EyeFromObject * vec4(a_Normal, 0.0));
}
