// The plugin that links OpenImageIO. No exception leaves a function: each returns false and a
// reason.

#include "images/image_plugin.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <string>

namespace
{

using namespace OIIO;

constexpr int CHANNELS = 4;

bool fail(char *reason, size_t size, std::string text)
{
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    for (char &c : text)
        c = c == '\n' ? ' ' : c;
    std::snprintf(reason, size, "%s", text.c_str());
    return false;
}

std::string or_unknown(const std::string &error)
{
    return error.empty() ? "no reason given" : error;
}

// The library writes the current time into TIFF and EXR files that have no date. These have the one
// of SOURCE_DATE_EPOCH (reproducible-builds.org), or the first of 1970, so that the same picture is
// the same file.
std::string set_date(ImageSpec &spec)
{
    constexpr long long LAST = 253402300799; // of the year 9999: the format has four digits
    const char *epoch = std::getenv("SOURCE_DATE_EPOCH");
    char *end = nullptr, text[32];
    const std::time_t seconds = epoch ? std::strtoll(epoch, &end, 10) : 0;
    std::tm date;
    if (epoch && (end == epoch || *end || seconds < 0 || seconds > LAST))
        return std::string("SOURCE_DATE_EPOCH=") + epoch + ": must be seconds since 1970";
    gmtime_r(&seconds, &date);
    std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &date);
    spec.attribute("DateTime", text);
    return "";
}

// The reason why it failed, or "".
std::string write(const Image *image, const char *format, const ImageOptions *options, int file)
{
    auto output = ImageOutput::create(std::string("picture.") + format);
    if (!output)
        return or_unknown(geterror());
    const TypeDesc type = image->type == IMAGE_FLOAT ? TypeDesc::FLOAT : TypeDesc::UINT8;
    const bool alpha = options->alpha && output->supports("alpha");
    ImageSpec spec(image->width, image->height, alpha ? CHANNELS : CHANNELS - 1, type);
    // Lossless if possible; WebP then still rounds when it converts colors.
    spec.attribute("Compression", std::strcmp(format, "webp") == 0     ? "lossless"
                                  : std::strncmp(format, "jp", 2) == 0 ? "jpeg:95"
                                                                       : "zip");
    // The only text of a TIFF file that is not a name or a date is its ImageDescription.
    const bool tiff = std::strncmp(format, "tif", 3) == 0;
    for (const ImageText *text = options->text; text && text->key; text++)
        spec.attribute(tiff && std::strcmp(text->key, "Command") == 0 ? "ImageDescription"
                                                                      : text->key,
                       text->text);
    const std::string error = set_date(spec);
    if (!error.empty())
        return error;
    // TIFF can store colors not multiplied by alpha; for other formats the library expects them
    // multiplied.
    ImageBuf own(ImageSpec(image->width, image->height, CHANNELS, type), image->pixels);
    if (alpha && tiff)
        spec.attribute("oiio:UnassociatedAlpha", 1);
    else if (alpha)
        own = ImageBufAlgo::premult(own);
    if (own.has_error())
        return or_unknown(own.geterror());
    if (!output->open("/proc/self/fd/" + std::to_string(file), spec) ||
        !output->write_image(type, own.localpixels(), CHANNELS * stride_t(type.size())) ||
        !output->close())
        return or_unknown(output->geterror());
    return "";
}

bool encode(const Image *image, const char *format, const ImageOptions *options, int file,
            char *reason, size_t reason_size)
{
    try {
        const std::string error = write(image, format, options, file);
        return error.empty() ? true : fail(reason, reason_size, error);
    } catch (const std::exception &exception) {
        return fail(reason, reason_size, exception.what());
    } catch (...) {
        return fail(reason, reason_size, "an unknown exception");
    }
}

const char *version()
{
    return OIIO_VERSION_STRING;
}

} // namespace

extern "C" __attribute__((visibility("default")))
const ImagePlugin image_plugin = {version, encode};
