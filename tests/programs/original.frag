#include "original.glsl"
uniform vec3 u_PerVertex; varying vec3 v_P, v_N, v_Color;
void main() {
  gl_FragColor = vec4(u_PerVertex.x > 0.5 ? v_Color : lit(v_P, normalize(v_N), v_Color), 1.0);
}
