// A shader of one's own: toon shading for PointLightedSphere_perFragment.
//   examples/run PointLightedSphere_perFragment --shaders shaders/toon
//
// New since the lecture's: the cosine in steps. An artist's rule, no physics: no reflection model
// is built into OpenGL, so that any can be written.

precision mediump float;

const float STEPS = 3.0; // of light; and the ambient light alone

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
    float toon = ceil(STEPS * nDotL) / STEPS;
    vec3 diffuse = u_LightColor * v_Color.rgb * toon;
    vec3 ambient = u_AmbientLight * v_Color.rgb;
    gl_FragColor = vec4(diffuse + ambient, v_Color.a);
}
