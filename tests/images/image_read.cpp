#include "images/image_read.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <cstdlib>

using namespace OIIO;

extern "C" bool image_read(Image *image, const char *path)
{
    // Colors as the file has them if it stores them not multiplied by alpha.
    ImageSpec wanted;
    wanted.attribute("oiio:UnassociatedAlpha", 1);
    ImageBuf file(path, 0, 0, nullptr, &wanted);
    if (!file.read(0, 0, true))
        return false;
    const bool bytes = file.spec().format == TypeDesc::UINT8;
    if (file.nchannels() == 4 && !file.spec().get_int_attribute("oiio:UnassociatedAlpha"))
        file = ImageBufAlgo::unpremult(file);
    const int order[] = {0, 1, 2, file.nchannels() == 4 ? 3 : -1};
    const float fill[] = {0, 0, 0, 1};
    file = ImageBufAlgo::channels(file, 4, order, fill);
    *image = {file.spec().width, file.spec().height, bytes ? IMAGE_BYTE : IMAGE_FLOAT, nullptr};
    image->pixels = std::malloc(file.spec().image_pixels() * (bytes ? 4 : 4 * sizeof(float)));
    return !file.has_error() && image->pixels &&
           file.get_pixels(file.roi(), bytes ? TypeDesc::UINT8 : TypeDesc::FLOAT, image->pixels);
}
