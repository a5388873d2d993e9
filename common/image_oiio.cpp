// What image.c asks of OpenImageIO, in C++. Built as a module, loaded at the first need.
// No exception leaves a function: each returns false with a reason.

#include "image_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

// The module's side of a GIF that is being written.
struct ModuleGif {
    std::FILE *file = nullptr;
    std::unique_ptr<OIIO::Filesystem::IOFile> proxy;
    std::unique_ptr<OIIO::ImageOutput> output; // writes to the proxy as long as it is there
    OIIO::ImageSpec spec;
    int added = 0;
};

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
    std::snprintf(reason, size, "%s", text.empty() ? "no reason given" : text.c_str());
    return false;
}

// Runs `work`, which returns an error ("" for none), and turns exceptions into errors.
template <typename Work> bool guarded(char *reason, size_t size, Work work)
{
    try {
        const std::string error = work();
        return error.empty() ? true : fail(reason, size, error);
    } catch (const std::exception &exception) {
        return fail(reason, size, exception.what());
    } catch (...) {
        return fail(reason, size, "an unknown exception");
    }
}

std::string or_unknown(const std::string &error)
{
    return error.empty() ? "no reason given" : error;
}

size_t value_size(const Image *image)
{
    return image->type == IMAGE_FLOAT ? sizeof(float) : 1;
}

TypeDesc type_of(const Image *image)
{
    return image->type == IMAGE_FLOAT ? TypeDesc::FLOAT : TypeDesc::UINT8;
}

// A view of our pixels, not a copy.
ImageBuf wrap(const Image *image)
{
    const ImageSpec spec(image->width, image->height, CHANNELS, type_of(image));
    return ImageBuf(spec, image->pixels);
}

bool can_write(const char *format)
{
    try {
        return ImageOutput::create(std::string("picture.") + format) != nullptr;
    } catch (...) {
        return false;
    }
}

bool encode(const Image *image, const char *format, const ImageOptions *options, int file,
            char *reason, size_t reason_size)
{
    return guarded(reason, reason_size, [&]() -> std::string {
        auto output = ImageOutput::create(std::string("picture.") + format);
        if (!output)
            return or_unknown(geterror());
        const bool alpha = options->alpha && output->supports("alpha");
        ImageSpec spec(image->width, image->height, alpha ? CHANNELS : CHANNELS - 1,
                       type_of(image));
        // Lossless where the library allows: its WebP is so but for a rounding of colours.
        spec.attribute("Compression", std::strcmp(format, "webp") == 0     ? "lossless"
                                      : std::strncmp(format, "jp", 2) == 0 ? "jpeg:95"
                                                                           : "zip");
        for (const ImageText *text = options->text; text && text->key; text++)
            spec.attribute(text->key, text->text);
        // Unmultiplied colours are kept where the format can say so; else multiplied by alpha, as
        // the library wants them.
        ImageBuf own = wrap(image);
        if (alpha && std::strncmp(format, "tif", 3) == 0)
            spec.attribute("oiio:UnassociatedAlpha", 1);
        else if (alpha)
            own = ImageBufAlgo::premult(own);
        if (own.has_error())
            return or_unknown(own.geterror());
        const std::string path = "/proc/self/fd/" + std::to_string(file);
        if (!output->open(path, spec))
            return or_unknown(output->geterror());
        if (!output->write_image(type_of(image), own.localpixels(),
                                 stride_t(CHANNELS * value_size(image))))
            return or_unknown(output->geterror());
        if (!output->close())
            return or_unknown(output->geterror());
        return "";
    });
}

// What the library writes is buffered, and it does not look whether that arrives.
std::string gif_error(const ModuleGif *gif)
{
    errno = 0;
    if (std::fflush(gif->file) == 0 && !std::ferror(gif->file))
        return "";
    return errno ? std::strerror(errno) : "cannot write";
}

bool gif_open(ModuleGif **opened, int file, int width, int height, int count, char *reason,
              size_t reason_size)
{
    return guarded(reason, reason_size, [&]() -> std::string {
        ModuleGif *gif = *opened = new ModuleGif;
        const int own = dup(file);
        gif->file = own < 0 ? nullptr : fdopen(own, "wb");
        if (!gif->file) {
            const std::string error = std::strerror(errno);
            if (own >= 0)
                close(own);
            return error;
        }
        gif->proxy = std::make_unique<Filesystem::IOFile>(gif->file, Filesystem::IOProxy::Write);
        gif->output = ImageOutput::create("picture.gif");
        if (!gif->output)
            return or_unknown(geterror());
        gif->spec = ImageSpec(width, height, CHANNELS - 1, TypeDesc::UINT8);
        gif->spec.attribute("FramesPerSecond", 10.0f); // without one, it does not repeat
        const std::vector<ImageSpec> specs(size_t(count), gif->spec);
        if (!gif->output->set_ioproxy(gif->proxy.get()) ||
            !gif->output->open("picture.gif", count, specs.data()))
            return or_unknown(gif->output->geterror());
        return "";
    });
}

bool gif_add(ModuleGif *gif, const Image *image, char *reason, size_t reason_size)
{
    return guarded(reason, reason_size, [&]() -> std::string {
        if ((gif->added++ > 0 &&
             !gif->output->open("picture.gif", gif->spec, ImageOutput::AppendSubimage)) ||
            !gif->output->write_image(TypeDesc::UINT8, image->pixels, CHANNELS))
            return or_unknown(gif->output->geterror());
        return gif_error(gif);
    });
}

bool gif_close(ModuleGif *gif, char *reason, size_t reason_size)
{
    if (!gif)
        return true;
    const bool done = guarded(reason, reason_size, [&]() -> std::string {
        if (!gif->output || !gif->output->close())
            return or_unknown(gif->output ? gif->output->geterror() : "");
        return gif_error(gif);
    });
    try {
        gif->output.reset();
        gif->proxy.reset();
    } catch (...) {
    }
    if (gif->file)
        std::fclose(gif->file);
    delete gif;
    return done;
}

bool read(const char *path, Image *image, char *reason, size_t reason_size)
{
    return guarded(reason, reason_size, [&]() -> std::string {
        // Colours as the file has them, where the format holds them unmultiplied.
        ImageSpec wanted;
        wanted.attribute("oiio:UnassociatedAlpha", 1);
        auto input = ImageInput::open(path, &wanted);
        if (!input)
            return or_unknown(geterror());
        const ImageSpec spec = input->spec();
        const ImageType type = spec.format == TypeDesc::UINT8 || spec.format == TypeDesc::INT8
                                   ? IMAGE_BYTE
                                   : IMAGE_FLOAT;
        // Freed by image_close, in C.
        *image = {spec.width, spec.height, type, nullptr};
        image->pixels =
            std::calloc(size_t(spec.width) * size_t(spec.height), CHANNELS * value_size(image));
        if (!image->pixels)
            return "not enough memory";
        const TypeDesc desc = type_of(image);
        ImageBuf own = wrap(image);
        // Grey to RGB; alpha 1 where there is none.
        const int n = spec.nchannels;
        const ImageSpec file_spec(spec.width, spec.height, n, desc);
        ImageBuf file(file_spec);
        if (!input->read_image(0, 0, 0, n, desc, file.localpixels()))
            return or_unknown(input->geterror());
        const int order[CHANNELS] = {0, n < 3 ? 0 : 1, n < 3 ? 0 : 2, n == 2 ? 1 : n > 3 ? 3 : -1};
        const float fill[CHANNELS] = {0, 0, 0, 1};
        ImageBuf spread = ImageBufAlgo::channels(file, CHANNELS, order, fill);
        spread.specmod().alpha_channel = CHANNELS - 1;
        if (spec.alpha_channel >= 0 && !spec.get_int_attribute("oiio:UnassociatedAlpha"))
            spread = ImageBufAlgo::unpremult(spread);
        if (spread.has_error())
            return or_unknown(spread.geterror());
        if (!spread.get_pixels(own.roi(), desc, image->pixels))
            return or_unknown(spread.geterror());
        return "";
    });
}

bool compare(const Image *a, const Image *b, ImageDifference *difference, char *reason,
             size_t reason_size)
{
    return guarded(reason, reason_size, [&]() -> std::string {
        const ImageBuf first = wrap(a), second = wrap(b);
        ROI roi = first.roi();
        roi.chend = CHANNELS - 1; // alpha is coverage, not colour
        const auto result = ImageBufAlgo::compare(first, second, 0.0f, 0.0f, roi);
        if (result.error && first.has_error())
            return or_unknown(first.geterror());
        difference->rms = 255 * result.rms_error;
        difference->maximum = 255 * result.maxerror;
        difference->x = result.maxx;
        difference->y = result.maxy;
        difference->differing = (long long)result.nfail;
        return "";
    });
}

bool make_difference(const Image *a, const Image *b, double gain, Image *difference, char *reason,
                     size_t reason_size)
{
    return guarded(reason, reason_size, [&]() -> std::string {
        const ImageBuf first = wrap(a), second = wrap(b);
        ImageBuf apart = ImageBufAlgo::absdiff(first, second);
        apart = ImageBufAlgo::mul(apart, float(gain));
        if (apart.has_error())
            return or_unknown(apart.geterror());
        if (!apart.get_pixels(first.roi(), TypeDesc::UINT8, difference->pixels))
            return or_unknown(apart.geterror());
        unsigned char *pixel = static_cast<unsigned char *>(difference->pixels);
        for (long i = 0; i < long(a->width) * a->height; i++)
            pixel[CHANNELS * i + 3] = 255;
        return "";
    });
}

bool label(Image *image, int x, int y, int size, const char *text, char *reason, size_t reason_size)
{
    return guarded(reason, reason_size, [&]() -> std::string {
        ImageBuf own = wrap(image);
        const float white[CHANNELS] = {1, 1, 1, 1};
        if (!ImageBufAlgo::render_text(own, x, y, text, size, "DejaVuSans", white,
                                       ImageBufAlgo::TextAlignX::Center))
            return or_unknown(own.geterror());
        return "";
    });
}

} // namespace

extern "C" __attribute__((visibility("default"))) const ImageModule *image_module(void)
{
    static const ImageModule module = {
        OIIO_VERSION_STRING, can_write, encode,  gif_open,        gif_add,
        gif_close,           read,      compare, make_difference, label,
    };
    return &module;
}
