/* The values of a captured draw, as its shaders get them. */
#include "probe/capture.h"

#include <string.h>

/* OpenGL ES 2.0.25, section 2.1.2: what is normalized is from -1 to 1 in steps of 2 / 255 or
 * 2 / 65535. */
static float number_at(const unsigned char *bytes, GLenum type, bool normalized)
{
    float number;
    short wide;
    unsigned short whole;
    switch (type) {
    case GL_FLOAT:
        memcpy(&number, bytes, sizeof number);
        return number;
    case GL_BYTE:
        return normalized ? (2 * (float)(signed char)*bytes + 1) / 255 : (float)(signed char)*bytes;
    case GL_SHORT:
        memcpy(&wide, bytes, sizeof wide);
        return normalized ? (2 * (float)wide + 1) / 65535 : wide;
    case GL_UNSIGNED_SHORT:
        memcpy(&whole, bytes, sizeof whole);
        return normalized ? (float)whole / 65535 : whole;
    default:
        return normalized ? (float)*bytes / 255 : *bytes;
    }
}

void capture_attribute(const CaptureAttribute *attribute, unsigned vertex, float value[4])
{
    static const float none[4] = {0, 0, 0, 1};
    const size_t one = attribute->type == GL_FLOAT                                           ? 4
                       : attribute->type == GL_SHORT || attribute->type == GL_UNSIGNED_SHORT ? 2
                                                                                             : 1;
    const size_t at = attribute->stride * vertex;
    memcpy(value, attribute->bytes ? none : attribute->value, sizeof none);
    for (int i = 0; attribute->bytes && i < attribute->size; i++)
        if (at + one * (size_t)(i + 1) <= attribute->byte_count)
            value[i] = number_at(attribute->bytes + at + one * (size_t)i, attribute->type,
                                 attribute->normalized);
}
