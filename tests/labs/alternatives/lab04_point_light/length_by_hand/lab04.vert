// Lab 4, without normalize().
attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;
uniform mat4 u_ViewMatrix;
uniform mat4 u_ProjMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2];
uniform vec3 u_AmbientLight;
varying vec4 v_Color;

float cosineBetween(vec3 a, vec3 b)
{
    return dot(a, b) * inversesqrt(dot(a, a) * dot(b, b));
}

void main()
{
    vec4 world = u_ModelMatrix * a_Position;
    gl_Position = u_ProjMatrix * u_ViewMatrix * world;
    vec3 n = mat3(u_NormalMatrix) * a_Normal.xyz;
    float a = cosineBetween(n, u_LightPosition[0] - world.xyz);
    float b = cosineBetween(n, u_LightPosition[1] - world.xyz);
    if (a < 0.0) a = 0.0;
    if (b < 0.0) b = 0.0;
    v_Color = a_Color * vec4(u_AmbientLight + a * u_LightColor[0] + b * u_LightColor[1], 1.0);
}
