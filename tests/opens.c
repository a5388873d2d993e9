/*
 * Canvases opened, drawn to, read and closed, again and again: what the process then holds must not
 * grow with their number.
 *
 * usage: opens BACKEND [COUNT]
 *
 * Says every tenth of the way what the process has, and fails where it has more file descriptors or
 * threads at the end than after the warm-up, or more memory than MOST_BYTES for each canvas. Exit
 * code: 77 where the backend opens none here.
 */
#include "canvas.h"
#include "options.h"

#include <dirent.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WARM_UP = 50, USUAL = 100, SIZE = 64 };

/* Mesa 22.3 itself keeps some: 130 to 170 bytes for a screen of EGL, 160 for each buffer that
 * OSMesaMakeCurrent makes and up to 300 in all, none for a window. A canvas's colour and depth are
 * 32 KiB. The address sanitizer's heap does not tell. */
static const double MOST_BYTES = 1024;

typedef struct Held {
    size_t heap, resident; /* bytes */
    int files, threads;
} Held;

static int entries(const char *path)
{
    int count = 0;
    DIR *folder = opendir(path);
    while (folder && readdir(folder))
        count++;
    if (folder)
        closedir(folder);
    return count;
}

static Held held(void)
{
    Held now = {.heap = mallinfo2().uordblks + mallinfo2().hblkhd,
                .files = entries("/proc/self/fd"),
                .threads = entries("/proc/self/task")};
    unsigned long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%*u %lu", &pages) != 1)
        pages = 0;
    if (file)
        fclose(file);
    now.resident = pages * (size_t)sysconf(_SC_PAGESIZE);
    return now;
}

static bool draw(const CanvasBackend *backend, Message *message)
{
    Canvas canvas;
    Image image = {.pixels = NULL};
    const CanvasOptions options = {
        .backend = backend, .width = SIZE, .height = SIZE, .title = "opens"};
    if (!canvas_open(&canvas, &options, message))
        return false;
    canvas_clear(&canvas, (Vec3){1, 0, 0}, 1);
    bool done = image_open(&image, SIZE, SIZE, IMAGE_BYTE, message) &&
                canvas_read(&canvas, &image, message);
    if (done && memcmp(image.pixels, "\xff\0\0\xff", 4) != 0)
        done = message_set(message, "what was drawn is not what was read");
    image_close(&image);
    canvas_close(&canvas);
    return done;
}

static void say(int count, Held now)
{
    printf("%6d canvases: %7.0f KiB in the heap, %7.0f KiB resident, %d files, %d threads\n", count,
           (double)now.heap / 1024, (double)now.resident / 1024, now.files, now.threads);
    fflush(stdout);
}

int main(int argc, char *argv[])
{
    Message message = {0};
    const CanvasBackend *backend = argc > 1 ? canvas_backend(argv[1], &message) : NULL;
    const int count = argc > 2 ? atoi(argv[2]) : USUAL;
    if (!backend || count < 1)
        return options_fail("opens", &message, EXIT_USAGE);
    if (!draw(backend, &message))
        return options_fail("opens", &message, 77);
    for (int i = 1; i < WARM_UP; i++)
        if (!draw(backend, &message))
            return options_fail("opens", &message, EXIT_FAILED);
    const Held before = held();
    say(0, before);
    for (int i = 1; i <= count; i++) {
        if (!draw(backend, &message))
            return options_fail("opens", &message, EXIT_FAILED);
        if (i % (count < 10 ? 1 : count / 10) == 0)
            say(i, held());
    }
    const Held after = held();
    const double grown = ((double)after.heap - (double)before.heap) / count;
    printf("%s: for each canvas %.1f bytes in the heap, %.1f resident\n", backend->name, grown,
           ((double)after.resident - (double)before.resident) / count);
    return after.files > before.files || after.threads > before.threads || grown > MOST_BYTES;
}
