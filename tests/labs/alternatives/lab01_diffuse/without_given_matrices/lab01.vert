// Uses neither the ready-made product nor the ready-made normal matrix.
attribute vec4 a_Position;
attribute vec4 a_Normal;
attribute vec4 a_Color;

uniform mat4 u_ModelMatrix;
uniform mat4 u_ViewMatrix;
uniform mat4 u_ProjMatrix;
uniform vec3 u_LightColor;
uniform vec3 u_LightDirection;

varying vec3 v_Light;
varying vec4 v_Base;

/* The cofactors of the upper left 3x3: the inverse transpose but for a factor. */
vec3 transformNormal(mat4 m, vec3 n)
{
    vec3 a = m[0].xyz, b = m[1].xyz, c = m[2].xyz;
    float s = sign(dot(a, cross(b, c)));
    return normalize(s * (cross(b, c) * n.x + cross(c, a) * n.y + cross(a, b) * n.z));
}

void main()
{
    gl_Position = u_ProjMatrix * (u_ViewMatrix * (u_ModelMatrix * a_Position));
    float d = dot(transformNormal(u_ModelMatrix, a_Normal.xyz), u_LightDirection);
    v_Light = u_LightColor * (d > 0.0 ? d : 0.0);
    v_Base = a_Color;
}
