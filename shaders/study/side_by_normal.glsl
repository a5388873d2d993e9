// side_by_normal.glsl: lighting/side.glsl by the interpolated normal.

bool is_front() {
    return dot(v_Normal, -v_Position) > 0.0;
}
