// PointLightedSphere_perFragment: light each fragment.

precision mediump float;

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // in the world
uniform vec3 u_AmbientLight;

varying vec4 v_Color;
varying vec3 v_Normal;
varying vec3 v_Position; // in the world

void main() {
    // Between vertices the interpolated normal is shorter than 1.
    vec3 normal = normalize(v_Normal);
    vec3 lightDirection = normalize(u_LightPosition - v_Position);
    // The cosine of the angle between light and normal; behind the surface there is no light.
    float nDotL = max(dot(lightDirection, normal), 0.0);
    vec3 diffuse = u_LightColor * v_Color.rgb * nDotL;
    vec3 ambient = u_AmbientLight * v_Color.rgb;
    gl_FragColor = vec4(diffuse + ambient, v_Color.a);
}
