/*
 * One thread takes the last picture that was handed over and has its error computed; a newer one
 * stops the older. Everything that both sides touch is under one lock, which is released while
 * computing; the flag that stops is atomic, because the computing threads read it without the lock.
 * What was computed for a picture that was stopped meanwhile is dropped.
 */
#include "choose/error_worker.h"

#include "base/clock.h"
#include "base/memory.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

struct ErrorWorker {
    pthread_t thread;
    pthread_mutex_t lock; /* of all that follows but `stop` */
    pthread_cond_t changed;
    ErrorPicture next; /* waits for the thread */
    bool waiting, computing, ended;
    ErrorResult result; /* without `computing` */
    Image map;          /* of the result */
    atomic_bool stop;   /* what is being computed */
};

/* Pictures. */

bool error_picture_open(ErrorPicture *picture, int width, int height, ImageType type, int max_views,
                        Message *message)
{
    *picture = (ErrorPicture){.views = memory_new((size_t)max_views, sizeof *picture->views)};
    if (image_open(&picture->image, width, height, type, message))
        return true;
    error_picture_close(picture);
    return false;
}

bool error_picture_add(ErrorPicture *picture, const int place[4], const Scene *scene,
                       const Scene *drawn, Message *message)
{
    ErrorView *view = &picture->views[picture->view_count];
    picture->view_count++;
    memcpy(view->place, place, sizeof view->place);
    return scene_copy_open_deep(&view->scene, scene, message) &&
           (!drawn || !scene_has_shadows(scene) ||
            scene_copy_open_deep(&view->drawn, drawn, message));
}

void error_picture_close(ErrorPicture *picture)
{
    if (!picture)
        return;
    for (int i = 0; i < picture->view_count; i++) {
        scene_copy_close(&picture->views[i].scene);
        scene_copy_close(&picture->views[i].drawn);
    }
    free(picture->views);
    image_close(&picture->image);
    *picture = (ErrorPicture){.views = NULL};
}

/* Computing. */

bool error_view_drawn(const ErrorView *view, const ReferenceOptions *exact, Reference *drawn,
                      Message *message)
{
    Scene scene = view->drawn.objects ? view->drawn.scene : view->scene.scene;
    ReferenceOptions options = *exact;
    *drawn = (Reference){.lights = NULL};
    if (!scene_has_shadows(&scene))
        return true;
    scene.interpolation = INTERPOLATION_PHONG;
    options.meshes = options.centers = true;
    options.edge_error = 255;
    return reference_open(drawn, &scene, &options, message);
}

/* A view's exact picture is made with these options; of them `threads` and `stop` are given. */
static ReferenceOptions options_of(const ErrorView *view, const ReferenceOptions *given)
{
    ReferenceOptions options = *given;
    options.width = view->place[2];
    options.height = view->place[3];
    return options;
}

/* The map gets its pixels, too. */
static bool add_view(PictureError *error, Image *map, const Image *image, const ErrorView *view,
                     const ReferenceOptions *given, Message *message)
{
    Reference exact, drawn = {.lights = NULL};
    const ReferenceOptions options = options_of(view, given);
    const bool done = reference_open(&exact, &view->scene.scene, &options, message) &&
                      error_view_drawn(view, &options, &drawn, message);
    const ExactView part = {.exact = &exact,
                            .scene = &view->scene.scene,
                            .drawn = drawn.lights ? &drawn : NULL,
                            .left = view->place[0],
                            .top = view->place[1]};
    if (done) {
        picture_error_add(error, image, &part);
        picture_error_map(map, image, &part);
    }
    reference_close(&exact);
    reference_close(&drawn);
    return done;
}

/* Against the meshes, whose edges do not count. */
static bool add_computing(PictureError *error, const Image *image, const ErrorView *view,
                          const ReferenceOptions *given, Message *message)
{
    Reference meshes;
    ReferenceOptions options = options_of(view, given);
    options.meshes = options.centers = true;
    options.edge_error = 255;
    if (!reference_open(&meshes, &view->scene.scene, &options, message))
        return false;
    picture_error_add(error, image,
                      &(ExactView){.exact = &meshes,
                                   .scene = &view->scene.scene,
                                   .left = view->place[0],
                                   .top = view->place[1]});
    reference_close(&meshes);
    return true;
}

static bool open_map(Image *map, const Image *image, Message *message)
{
    if (!image_open(map, image->width, image->height, IMAGE_BYTE, message))
        return false;
    for (size_t i = 0; i < (size_t)map->width * (size_t)map->height; i++)
        memcpy((unsigned char *)map->pixels + 4 * i, (const unsigned char[4]){0, 0, 0, 255}, 4);
    return true;
}

static bool compute(const ErrorPicture *picture, const ReferenceOptions *given, ErrorResult *result,
                    Image *map)
{
    PictureError computing = {.all = {0}};
    Message *message = &result->message;
    if (!open_map(map, &picture->image, message))
        return false;
    for (int i = 0; i < picture->view_count; i++) {
        const ErrorView *view = &picture->views[i];
        if (!add_view(&result->error, map, &picture->image, view, given, message) ||
            (!picture->simplified &&
             !add_computing(&computing, &picture->image, view, given, message)))
            return false;
    }
    result->of_computing = computing.interior;
    return true;
}

/* Leaves one core to the frames. */
static int thread_count(void)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return cores > 2 ? (int)(cores - 1) : 1;
}

/* On Linux a priority belongs to a thread, and the threads that it starts inherit it. */
static void step_back(void)
{
#ifdef __linux__
    /* A tenth of the frames' share; not less, because the last picture is waited for. */
    enum { NICE = 10 };
    setpriority(PRIO_PROCESS, 0, NICE); /* if it fails, frames are less smooth */
#endif
}

/* Called with the lock held; releases it while computing. */
static void compute_next(ErrorWorker *worker)
{
    ErrorPicture picture = worker->next;
    ErrorResult result = {.seconds = picture.seconds, .number = worker->result.number + 1};
    Image map = {.pixels = NULL};
    worker->next = (ErrorPicture){.views = NULL};
    worker->waiting = false;
    worker->computing = true;
    atomic_store(&worker->stop, false);
    pthread_mutex_unlock(&worker->lock);
    const double start = clock_now();
    const ReferenceOptions given = {.threads = thread_count(), .stop = &worker->stop};
    result.known = compute(&picture, &given, &result, &map);
    result.milliseconds = 1e3 * (clock_now() - start);
    error_picture_close(&picture);
    pthread_mutex_lock(&worker->lock);
    worker->computing = false;
    if (!atomic_load(&worker->stop)) {
        const Image before = worker->map;
        worker->result = result;
        worker->map = map;
        map = before;
    }
    image_close(&map);
}

static void *work(void *argument)
{
    ErrorWorker *worker = argument;
    step_back();
    pthread_mutex_lock(&worker->lock);
    while (!worker->ended) {
        if (worker->waiting)
            compute_next(worker);
        else
            pthread_cond_wait(&worker->changed, &worker->lock);
    }
    pthread_mutex_unlock(&worker->lock);
    return NULL;
}

/* The caller's side. */

static void destroy(ErrorWorker *worker)
{
    error_picture_close(&worker->next);
    image_close(&worker->map);
    pthread_cond_destroy(&worker->changed);
    pthread_mutex_destroy(&worker->lock);
    free(worker);
}

bool error_worker_open(ErrorWorker **opened, Message *message)
{
    ErrorWorker *worker = memory_new(1, sizeof *worker);
    *opened = NULL;
    pthread_mutex_init(&worker->lock, NULL);
    pthread_cond_init(&worker->changed, NULL);
    atomic_init(&worker->stop, false);
    const int error = pthread_create(&worker->thread, NULL, work, worker);
    if (error) {
        destroy(worker);
        return message_set(message, "error worker: cannot start a thread: %s", strerror(error));
    }
    *opened = worker;
    return true;
}

/* With the lock held: drops the waiting picture and stops the current one. */
static void abandon(ErrorWorker *worker)
{
    error_picture_close(&worker->next);
    worker->waiting = false;
    atomic_store(&worker->stop, true);
}

void error_worker_start(ErrorWorker *worker, ErrorPicture *picture)
{
    pthread_mutex_lock(&worker->lock);
    abandon(worker);
    worker->next = *picture;
    worker->waiting = true;
    pthread_cond_signal(&worker->changed);
    pthread_mutex_unlock(&worker->lock);
    *picture = (ErrorPicture){.views = NULL};
}

/* With the lock held. A stopped picture does not count. */
static bool busy(const ErrorWorker *worker)
{
    return worker->waiting || (worker->computing && !atomic_load(&worker->stop));
}

bool error_worker_busy(ErrorWorker *worker)
{
    pthread_mutex_lock(&worker->lock);
    const bool is_busy = busy(worker);
    pthread_mutex_unlock(&worker->lock);
    return is_busy;
}

void error_worker_result(ErrorWorker *worker, ErrorResult *result)
{
    pthread_mutex_lock(&worker->lock);
    *result = worker->result;
    result->computing = busy(worker);
    pthread_mutex_unlock(&worker->lock);
}

bool error_worker_map(ErrorWorker *worker, Image *map)
{
    pthread_mutex_lock(&worker->lock);
    const Image *own = &worker->map;
    bool done = worker->result.known && own->pixels;
    if (done && (map->width != own->width || map->height != own->height)) {
        image_close(map);
        done = image_open(map, own->width, own->height, IMAGE_BYTE, NULL);
    }
    if (done)
        memcpy(map->pixels, own->pixels, image_row_size(own) * (size_t)own->height);
    pthread_mutex_unlock(&worker->lock);
    return done;
}

void error_worker_cancel(ErrorWorker *worker)
{
    pthread_mutex_lock(&worker->lock);
    abandon(worker);
    worker->result = (ErrorResult){.known = false, .number = worker->result.number + 1};
    pthread_mutex_unlock(&worker->lock);
}

void error_worker_close(ErrorWorker *worker)
{
    if (!worker)
        return;
    pthread_mutex_lock(&worker->lock);
    abandon(worker);
    worker->ended = true;
    pthread_cond_signal(&worker->changed);
    pthread_mutex_unlock(&worker->lock);
    pthread_join(worker->thread, NULL);
    destroy(worker);
}
