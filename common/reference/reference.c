/*
 * Threads take bands of rows in turn, so that none waits for another's harder rows. A band samples
 * the corners, sides and centers of its pixels row by row; those on the border of two bands are
 * sampled twice, and are the same. So the picture does not depend on the number of threads.
 */
#include "reference/reference.h"

#include "reference/reference_pixel.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

enum { BAND = 8, MAX_THREADS = 256 };
static const double EDGE_ERROR = 0.5;

typedef struct Job {
    Reference *reference;
    PixelTracer tracer; /* without `recent` */
    bool centers;
    const atomic_bool *stop;
    Progress *progress;
    atomic_int next; /* band */
} Job;

typedef struct Worker {
    Job *job;
    PixelTracer tracer;
    Sample *samples;    /* three rows */
    Progress *progress; /* of one of them */
    pthread_t thread;
} Worker;

static void sample_row(const Job *job, int row, Sample *samples)
{
    for (int i = 0; i <= 2 * job->reference->width; i++)
        trace_sample(job->tracer.trace, i / 2.0, row / 2.0, &samples[i]);
}

static void put_pixel(const Job *job, int x, int y, const Sample *center, const Pixel *pixel)
{
    Reference *reference = job->reference;
    const size_t i = (size_t)y * (size_t)reference->width + (size_t)x;
    for (size_t k = 0; k < 3; k++)
        reference->color[3 * i + k] = job->centers ? center->color[k] : pixel->color[k];
    reference->depth[i] = center->depth;
    reference->object[i] = center->object;
    reference->coverage[i] = pixel->coverage;
    reference->interior[i] = pixel->interior;
}

static void draw_band(const Worker *worker, int band)
{
    const Job *job = worker->job;
    const Reference *reference = job->reference;
    const size_t length = 2 * (size_t)reference->width + 1;
    Sample *top = worker->samples, *middle = top + length, *bottom = middle + length;
    const int first = band * BAND;
    sample_row(job, 2 * first, top);
    for (int y = first; y < first + BAND && y < reference->height; y++) {
        if (stop_asked(job->stop))
            return;
        sample_row(job, 2 * y + 1, middle);
        sample_row(job, 2 * y + 2, bottom);
        for (int x = 0; x < reference->width; x++) {
            const Sample *const rows[] = {top + 2 * x, middle + 2 * x, bottom + 2 * x};
            const Pixel pixel = pixel_resolve(&worker->tracer, x, y, rows);
            put_pixel(job, x, y, &rows[1][1], &pixel);
            if (reference->lights)
                reference->lights[(size_t)y * (size_t)reference->width + (size_t)x] =
                    trace_pixel_lights(rows);
        }
        Sample *above = top;
        top = bottom;
        bottom = above;
    }
}

static int band_count(const Reference *reference)
{
    return (reference->height + BAND - 1) / BAND;
}

static void *work(void *argument)
{
    const Worker *worker = argument;
    Job *job = worker->job;
    const int count = band_count(job->reference);
    for (int band = atomic_fetch_add(&job->next, 1); band < count && !stop_asked(job->stop);
         band = atomic_fetch_add(&job->next, 1)) {
        if (worker->progress)
            progress_update(worker->progress, band, count);
        draw_band(worker, band);
    }
    return NULL;
}

/* This thread works too: where others cannot be had it does all. */
static bool draw_bands(Job *job, int threads)
{
    const size_t length = 3 * (2 * (size_t)job->reference->width + 1);
    const int bands = band_count(job->reference), count = threads < bands ? threads : bands;
    Worker *workers = calloc((size_t)count, sizeof *workers);
    int ready = 0, running = 1;
    while (workers && ready < count) {
        Worker *worker = &workers[ready];
        *worker = (Worker){job, job->tracer, malloc(length * sizeof(Sample)), NULL, 0};
        worker->tracer.recent = calloc(PIXEL_RECENT, sizeof(PixelRecent));
        if (!worker->samples || !worker->tracer.recent)
            break;
        ready++;
    }
    while (running < ready &&
           pthread_create(&workers[running].thread, NULL, work, &workers[running]) == 0)
        running++;
    if (ready > 0) {
        workers[0].progress = job->progress;
        work(&workers[0]);
    }
    for (int i = 1; i < running && i < ready; i++)
        pthread_join(workers[i].thread, NULL);
    for (int i = 0; workers && i < count; i++) {
        free(workers[i].samples);
        free(workers[i].tracer.recent);
    }
    free(workers);
    return ready > 0;
}

static bool check(const ReferenceOptions *options, Message *message)
{
    if (options->width < 1 || options->height < 1)
        return message_set(message, "reference: size %dx%d: must be 1x1 or more", options->width,
                           options->height);
    if (!(options->edge_error >= 0 && options->edge_error <= 255))
        return message_set(message, "reference: edge error %g: must be 0 to 255",
                           options->edge_error);
    if (options->threads < 0)
        return message_set(message, "reference: %d threads: must be 0 or more", options->threads);
    return true;
}

static bool open_pixels(Reference *reference, bool casts)
{
    const size_t count = (size_t)reference->width * (size_t)reference->height;
    reference->color = calloc(count, 3 * sizeof *reference->color);
    reference->depth = calloc(count, sizeof *reference->depth);
    reference->object = calloc(count, sizeof *reference->object);
    reference->coverage = calloc(count, sizeof *reference->coverage);
    reference->interior = calloc(count, sizeof *reference->interior);
    if (casts)
        reference->lights = calloc(count, sizeof *reference->lights);
    return (!casts || reference->lights) && reference->color && reference->depth &&
           reference->object && reference->coverage && reference->interior;
}

bool reference_open(Reference *reference, const Scene *scene, const ReferenceOptions *options,
                    Message *message)
{
    Trace *trace = NULL;
    ReferenceOptions own = *options;
    const long count = options->threads > 0 ? options->threads : sysconf(_SC_NPROCESSORS_ONLN);
    own.threads = count < 1 ? 1 : count > MAX_THREADS ? MAX_THREADS : (int)count;
    *reference = (Reference){0};
    if (!check(options, message) || !trace_open(&trace, scene, &own, message))
        return false;
    *reference = (Reference){.width = options->width, .height = options->height};
    Job job = {.reference = reference,
               .tracer = {trace, options->edge_error > 0 ? options->edge_error : EDGE_ERROR, NULL},
               .centers = options->centers,
               .stop = options->stop,
               .progress = options->progress};
    const bool done = open_pixels(reference, trace_casts(trace)) && draw_bands(&job, own.threads);
    trace_close(trace);
    const bool stopped = stop_asked(options->stop);
    if (done && !stopped)
        return true;
    reference_close(reference);
    if (stopped)
        return message_set(message, "reference: stopped");
    return message_set(message, "reference: %dx%d pixels: not enough memory", options->width,
                       options->height);
}

void reference_close(Reference *reference)
{
    if (!reference)
        return;
    free(reference->color);
    free(reference->depth);
    free(reference->object);
    free(reference->coverage);
    free(reference->interior);
    free(reference->lights);
    *reference = (Reference){0};
}

bool reference_image(const Reference *exact, Image *image, Message *message)
{
    if (!image_open(image, exact->width, exact->height, IMAGE_BYTE, message))
        return false;
    unsigned char *out = image->pixels;
    for (size_t i = 0; i < 4 * (size_t)exact->width * (size_t)exact->height; i++)
        out[i] =
            i % 4 == 3 ? 255 : (unsigned char)lround(255 * (double)exact->color[i / 4 * 3 + i % 4]);
    return true;
}
