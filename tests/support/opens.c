/*
 * Opens, draws, reads and closes canvases repeatedly, to find leaks.
 *
 * usage: opens BACKEND [COUNT]
 *
 * Prints the resources of the process ten times, and fails if it has more file descriptors or
 * threads at the end than after the warm-up, or more than MAX_BYTES of heap for each canvas. Exit
 * code 77: the backend cannot open a canvas here.
 */
#include "app/options.h"
#include "core/canvas.h"
#include "window/backends.h"

#include <dirent.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WARM_UP = 50, USUAL = 100, SIZE = 64 };

/* Mesa 22.3 leaks some: 130 to 170 bytes for an EGL canvas, up to 300 for an OSMesa one, none for a
 * window; Mesa 25.0 up to 1030 for each of the first hundred OSMesa canvases, 370 to 490 for each
 * of 400. A canvas's colour and depth buffers have 32 KiB. AddressSanitizer does not report its
 * heap.
 */
static const double MAX_BYTES = 2048;

typedef struct Resources {
    size_t heap, resident; /* bytes */
    int files, threads;
} Resources;

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

static Resources resources(void)
{
    Resources now = {.heap = mallinfo2().uordblks + mallinfo2().hblkhd,
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

static bool draw_one(const CanvasBackend *backend, Message *message)
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
        done = message_set(message, "the pixels read are not those drawn");
    image_close(&image);
    canvas_close(&canvas);
    return done;
}

static void print_resources(int count, Resources now)
{
    printf("%6d canvases: %7.0f KiB in the heap, %7.0f KiB resident, %d files, %d threads\n", count,
           (double)now.heap / 1024, (double)now.resident / 1024, now.files, now.threads);
    fflush(stdout);
}

int main(int argc, char *argv[])
{
    Message message = {0};
    const CanvasBackend *backend = argc > 1 ? backend_find(argv[1], &message) : NULL;
    const int count = argc > 2 ? atoi(argv[2]) : USUAL;
    if (!backend || count < 1)
        return options_fail("opens", &message, EXIT_USAGE);
    if (!draw_one(backend, &message))
        return options_fail("opens", &message, 77);
    for (int i = 1; i < WARM_UP; i++)
        if (!draw_one(backend, &message))
            return options_fail("opens", &message, EXIT_FAILED);
    const Resources before = resources();
    print_resources(0, before);
    for (int i = 1; i <= count; i++) {
        if (!draw_one(backend, &message))
            return options_fail("opens", &message, EXIT_FAILED);
        if (i % (count < 10 ? 1 : count / 10) == 0)
            print_resources(i, resources());
    }
    const Resources after = resources();
    const double grown = ((double)after.heap - (double)before.heap) / count;
    printf("%s: for each canvas %.1f bytes in the heap, %.1f resident\n", backend->name, grown,
           ((double)after.resident - (double)before.resident) / count);
    return after.files > before.files || after.threads > before.threads || grown > MAX_BYTES;
}
