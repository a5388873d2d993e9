precision highp float;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2];
uniform vec3 u_AmbientLight;
varying vec4 v_Color;
varying vec4 v_Model;
varying vec3 v_ModelNormal;
void main() {
    vec3 p = vec3(u_ModelMatrix * v_Model);
    vec3 n = normalize(mat3(u_NormalMatrix) * v_ModelNormal);
    vec3 c = u_AmbientLight;
    for (int i = 0; i < 2; i++)
        c += u_LightColor[i] * max(dot(n, normalize(u_LightPosition[i] - p)), 0.0);
    gl_FragColor = vec4(c * v_Color.rgb, v_Color.a);
}
