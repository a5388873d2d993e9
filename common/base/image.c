/* Pixels in one block. */
#include "base/image.h"

#include <stdlib.h>

static size_t value_size(ImageType type)
{
    return type == IMAGE_FLOAT ? sizeof(float) : 1;
}

size_t image_row_size(const Image *image)
{
    return 4 * (size_t)image->width * value_size(image->type);
}

bool image_open(Image *image, int width, int height, ImageType type, Message *message)
{
    *image = (Image){.width = width, .height = height, .type = type};
    if (width < 1 || height < 1)
        return message_set(message, "image: size %dx%d: must be at least 1x1", width, height);
    image->pixels = calloc((size_t)height, image_row_size(image));
    if (!image->pixels)
        return message_set(message, "image: not enough memory for %dx%d pixels", width, height);
    return true;
}

void image_close(Image *image)
{
    if (!image)
        return;
    free(image->pixels);
    *image = (Image){0};
}
