#include "original.glsl"
attribute vec4 a_Position; attribute vec3 a_Normal, a_Color;
uniform mat4 u_Clip, u_Eye, u_Normals; uniform vec3 u_PerVertex;
varying vec3 v_P, v_N, v_Color;
void main() {
  v_P = vec3(u_Eye * a_Position); v_N = normalize(vec3(u_Normals * vec4(a_Normal, 0.0)));
  v_Color = u_PerVertex.x > 0.5 ? lit(v_P, v_N, a_Color) : a_Color;
  gl_Position = u_Clip * vec4(v_P, 1.0);
}
