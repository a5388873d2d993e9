// PointLightedSphere_perFragment: lights each fragment.

precision mediump float;

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // world coordinates
uniform vec3 u_AmbientLight;

varying vec4 v_Color;
varying vec3 v_Normal;
varying vec3 v_Position; // world coordinates

void main() {
    // Interpolated normals may be shorter than 1.
    vec3 normal = normalize(v_Normal);
    vec3 lightDirection = normalize(u_LightPosition - v_Position);
    // Cosine of the angle between light and normal; 0 behind the surface.
    float nDotL = max(dot(lightDirection, normal), 0.0);
    vec3 diffuse = u_LightColor * v_Color.rgb * nDotL;
    vec3 ambient = u_AmbientLight * v_Color.rgb;
    gl_FragColor = vec4(diffuse + ambient, v_Color.a);
}
