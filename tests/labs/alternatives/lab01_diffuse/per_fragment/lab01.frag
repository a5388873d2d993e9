#ifdef GL_ES
precision highp float;
#endif
varying vec3 n;
varying vec3 kd;
uniform vec3 u_LightDirection;
uniform vec3 u_LightColor;

void main()
{
    vec3 N = normalize(n);
    vec3 L = normalize(u_LightDirection);
    float lambert = dot(N, L);
    if (lambert < 0.0)
        lambert = 0.0;
    gl_FragColor = vec4(lambert * kd * u_LightColor, 1.0);
}
