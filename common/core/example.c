/* The camera of a frame, if the viewer has moved it. */
#include "core/example.h"

Mat4 frame_look_at(const Frame *frame, Vec3 eye, Vec3 center, Vec3 up)
{
    orbit_move(frame->orbit, &eye, center, &up);
    return mat4_look_at(eye, center, up);
}
