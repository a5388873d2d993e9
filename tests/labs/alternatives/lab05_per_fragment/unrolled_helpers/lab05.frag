#version 100
precision highp float;
varying vec3 pos;
varying vec3 nrm;
varying vec4 col;
uniform vec3 u_LightPosition[2];
uniform vec3 u_LightColor[2];
uniform vec3 u_AmbientLight;

float saturate(float x) { return clamp(x, 0.0, 1.0); }

vec3 diffuse(vec3 N, vec3 lightPosition, vec3 lightColor)
{
    vec3 L = lightPosition - pos;
    return saturate(dot(N, L) / length(L)) * lightColor;
}

void main()
{
    vec3 N = nrm / sqrt(dot(nrm, nrm));
    gl_FragColor.rgb = col.rgb * u_AmbientLight
                     + col.rgb * diffuse(N, u_LightPosition[0], u_LightColor[0])
                     + col.rgb * diffuse(N, u_LightPosition[1], u_LightColor[1]);
    gl_FragColor.a = col.a;
}
