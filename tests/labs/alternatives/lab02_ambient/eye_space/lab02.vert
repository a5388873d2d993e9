attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec3 a_Normal;
uniform mat4 u_ModelViewMatrix;
uniform mat4 u_ProjMatrix;
uniform mat4 u_ViewMatrix;
uniform mat4 u_EyeNormalMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightDirection[2];
uniform vec3 u_AmbientLight;
varying vec4 v_Color;

vec3 toEye(vec3 direction) { return mat3(u_ViewMatrix) * direction; }

void main() {
    gl_Position = u_ProjMatrix * u_ModelViewMatrix * a_Position;
    vec3 n = normalize(mat3(u_EyeNormalMatrix) * a_Normal);
    vec3 result = a_Color.rgb * u_AmbientLight;
    result += a_Color.rgb * u_LightColor[0] * max(0.0, dot(n, toEye(u_LightDirection[0])));
    result += a_Color.rgb * u_LightColor[1] * max(0.0, dot(n, toEye(u_LightDirection[1])));
    v_Color = vec4(result, 1.0);
}
