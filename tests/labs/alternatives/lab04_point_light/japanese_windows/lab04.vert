// 課題4: 点光源
attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;
uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;   // モデル行列
uniform mat4 u_NormalMatrix;  // 法線用
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2]; // ワールド座標
uniform vec3 u_AmbientLight;
varying vec4 v_Color;
void main() {
  gl_Position = u_MvpMatrix * a_Position;
  vec3 normal = normalize(vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0)));
  vec4 vertexPosition = u_ModelMatrix * a_Position;
  vec3 ambient = u_AmbientLight * a_Color.rgb;
  vec3 diffuse = vec3(0.0);
  for (int i = 0; i < 2; i++) {
    vec3 lightDirection = normalize(u_LightPosition[i] - vec3(vertexPosition));
    float nDotL = max(dot(lightDirection, normal), 0.0);
    diffuse += u_LightColor[i] * a_Color.rgb * nDotL;
  }
  v_Color = vec4(diffuse + ambient, a_Color.a);
}
