attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;
uniform mat4 u_MvpMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightDirection[2];
uniform vec3 u_AmbientLight;
varying vec4 v_Color;
void main() {
    gl_Position = u_MvpMatrix * a_Position;
    vec3 normal = normalize(vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0)));
    float nDotL0 = max(dot(u_LightDirection[0], normal), 0.0);
    float nDotL1 = max(dot(u_LightDirection[1], normal), 0.0);
    vec3 diffuse0 = u_LightColor[0] * a_Color.rgb * nDotL0;
    vec3 diffuse1 = u_LightColor[1] * a_Color.rgb * nDotL1;
    vec3 ambient = u_AmbientLight * a_Color.rgb;
    v_Color = vec4(diffuse0 + diffuse1 + ambient, a_Color.a);
}
