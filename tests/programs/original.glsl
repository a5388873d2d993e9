// The originals' equation, in eye coordinates; at the vertices or at the fragments.
precision highp float;
uniform vec3 u_Ambient, u_Diffuse, u_Specular, u_Emission, u_Global, u_Axis;
uniform vec3 u_Ways; // shininess; 1: Blinn's highlight; 1: a local viewer
uniform vec3 u_Place[4], u_Kind[4]; // kind: w; 1: on; the cosine of a cutoff
uniform vec3 u_LightAmbient[4], u_LightDiffuse[4], u_LightSpecular[4];
vec3 lit(vec3 p, vec3 n, vec3 surface) {
  vec3 v = u_Ways.z > 0.5 ? normalize(-p) : vec3(0.0, 0.0, 1.0);
  vec3 sum = u_Emission + u_Global * u_Ambient * surface;
  for (int i = 0; i < 4; i++) {
    vec3 l = normalize(u_Place[i] - u_Kind[i].x * p);
    float facing = dot(l, n);
    if (u_Kind[i].y < 0.5) continue;
    sum += u_LightAmbient[i] * u_Ambient * surface;
    if (facing <= 0.0 || dot(-l, u_Axis) < u_Kind[i].z) continue;
    float c = u_Ways.y > 0.5 ? dot(normalize(l + v), n) : dot(2.0 * facing * n - l, v);
    sum += facing * u_LightDiffuse[i] * u_Diffuse * surface;
    if (c > 0.0) sum += pow(c, u_Ways.x) * u_LightSpecular[i] * u_Specular;
  }
  return sum;
}
