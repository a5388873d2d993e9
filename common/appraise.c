#include "appraise.h"

#include "progress.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

struct Appraise {
    pthread_t thread;
    pthread_mutex_t lock; /* of all that follows but `stop` */
    pthread_cond_t changed;
    AppraisePicture next; /* waits for the thread */
    bool waiting, computing, ended;
    AppraiseResult result; /* without `computing` */
    atomic_bool stop;      /* what is being computed */
};

/* Pictures. */

bool appraise_picture_open(AppraisePicture *picture, int width, int height, ImageType type,
                           int most_views, Message *message)
{
    *picture = (AppraisePicture){.views = calloc((size_t)most_views + 1, sizeof *picture->views)};
    if (!picture->views)
        return message_set(message, "appraise: not enough memory for %d views", most_views);
    if (image_open(&picture->image, width, height, type, message))
        return true;
    appraise_picture_close(picture);
    return false;
}

bool appraise_picture_add(AppraisePicture *picture, const int place[4], const Scene *asked,
                          const Scene *drawn, Message *message)
{
    AppraiseView *view = &picture->views[picture->view_count];
    picture->view_count++;
    memcpy(view->place, place, sizeof view->place);
    return scene_copy_open(&view->asked, asked, message) &&
           (!drawn || scene_copy_open(&view->drawn, drawn, message));
}

static void view_close(AppraiseView *view)
{
    scene_copy_close(&view->asked);
    scene_copy_close(&view->drawn);
}

void appraise_picture_close(AppraisePicture *picture)
{
    if (!picture)
        return;
    for (int i = 0; i < picture->view_count; i++)
        view_close(&picture->views[i]);
    free(picture->views);
    image_close(&picture->image);
    *picture = (AppraisePicture){.views = NULL};
}

/* Computing. */

/* Where each object is, as drawn: its mesh in no light. */
static Scene shapes_of(const AppraiseView *view)
{
    Scene scene = view->drawn.objects ? view->drawn.scene : view->asked.scene;
    scene.light_count = 0;
    scene.interpolation = INTERPOLATION_PHONG;
    return scene;
}

static bool has_solids(const Scene *scene)
{
    for (int i = 0; i < scene->object_count; i++)
        if (scene->objects[i].solid.kind != SOLID_NONE)
            return true;
    return false;
}

static bool add_view(ReferenceError *error, const Image *image, const AppraiseView *view,
                     int threads, const atomic_bool *stop, Message *message)
{
    const Scene shapes = shapes_of(view);
    const bool differ = has_solids(&view->asked.scene);
    Reference exact = {.width = 0}, drawn = {.width = 0};
    const ReferenceOptions options = {
        .width = view->place[2], .height = view->place[3], .threads = threads, .stop = stop};
    ReferenceOptions of_meshes = options;
    of_meshes.meshes = true;
    of_meshes.edge_error = 255; /* colours do not count */
    const bool done = reference_open(&exact, &view->asked.scene, &options, message) &&
                      (!differ || reference_open(&drawn, &shapes, &of_meshes, message));
    if (done)
        reference_error_add(error, image, view->place[0], view->place[1], &exact,
                            differ ? &drawn : NULL);
    reference_close(&exact);
    reference_close(&drawn);
    return done;
}

bool appraise_compute(const AppraisePicture *picture, int threads, const atomic_bool *stop,
                      ReferenceError *error, Message *message)
{
    *error = (ReferenceError){.all = {0}};
    for (int i = 0; i < picture->view_count; i++)
        if (!add_view(error, &picture->image, &picture->views[i], threads, stop, message))
            return false;
    return true;
}

/* One core is left to the frames. */
static int thread_count(void)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return cores > 2 ? (int)(cores - 1) : 1;
}

/* On Linux a priority is that of a thread, and of those that it starts. */
static void step_back(void)
{
#ifdef __linux__
    /* A tenth of a frame's share. Not less, for at the end somebody waits for what has begun. */
    enum { NICE = 10 };
    setpriority(PRIO_PROCESS, 0, NICE); /* where it fails, frames are a little less smooth */
#endif
}

/* Takes the lock in turns: not while computing. */
static void compute_next(Appraise *appraise)
{
    AppraisePicture picture = appraise->next;
    AppraiseResult result = {.seconds = picture.seconds};
    appraise->next = (AppraisePicture){.views = NULL};
    appraise->waiting = false;
    appraise->computing = true;
    atomic_store(&appraise->stop, false);
    pthread_mutex_unlock(&appraise->lock);
    const double start = progress_now();
    result.known =
        appraise_compute(&picture, thread_count(), &appraise->stop, &result.error, &result.message);
    result.milliseconds = 1e3 * (progress_now() - start);
    appraise_picture_close(&picture);
    pthread_mutex_lock(&appraise->lock);
    appraise->computing = false;
    if (!atomic_load(&appraise->stop))
        appraise->result = result;
}

static void *work(void *argument)
{
    Appraise *appraise = argument;
    step_back();
    pthread_mutex_lock(&appraise->lock);
    while (!appraise->ended) {
        if (appraise->waiting)
            compute_next(appraise);
        else
            pthread_cond_wait(&appraise->changed, &appraise->lock);
    }
    pthread_mutex_unlock(&appraise->lock);
    return NULL;
}

/* The caller's side. */

static void destroy(Appraise *appraise)
{
    appraise_picture_close(&appraise->next);
    pthread_cond_destroy(&appraise->changed);
    pthread_mutex_destroy(&appraise->lock);
    free(appraise);
}

bool appraise_open(Appraise **opened, Message *message)
{
    Appraise *appraise = calloc(1, sizeof *appraise);
    *opened = NULL;
    if (!appraise)
        return message_set(message, "appraise: not enough memory");
    pthread_mutex_init(&appraise->lock, NULL);
    pthread_cond_init(&appraise->changed, NULL);
    atomic_init(&appraise->stop, false);
    const int error = pthread_create(&appraise->thread, NULL, work, appraise);
    if (error) {
        destroy(appraise);
        return message_set(message, "appraise: cannot start a thread: %s", strerror(error));
    }
    *opened = appraise;
    return true;
}

/* With the lock held: drops what is waiting, stops what is being computed. */
static void abandon(Appraise *appraise)
{
    appraise_picture_close(&appraise->next);
    appraise->waiting = false;
    atomic_store(&appraise->stop, true);
}

void appraise_start(Appraise *appraise, AppraisePicture *picture)
{
    pthread_mutex_lock(&appraise->lock);
    abandon(appraise);
    appraise->next = *picture;
    appraise->waiting = true;
    pthread_cond_signal(&appraise->changed);
    pthread_mutex_unlock(&appraise->lock);
    *picture = (AppraisePicture){.views = NULL};
}

/* With the lock held. What was abandoned is as good as gone. */
static bool busy(const Appraise *appraise)
{
    return appraise->waiting || (appraise->computing && !atomic_load(&appraise->stop));
}

bool appraise_busy(Appraise *appraise)
{
    pthread_mutex_lock(&appraise->lock);
    const bool is_busy = busy(appraise);
    pthread_mutex_unlock(&appraise->lock);
    return is_busy;
}

void appraise_result(Appraise *appraise, AppraiseResult *result)
{
    pthread_mutex_lock(&appraise->lock);
    *result = appraise->result;
    result->computing = busy(appraise);
    pthread_mutex_unlock(&appraise->lock);
}

void appraise_cancel(Appraise *appraise)
{
    pthread_mutex_lock(&appraise->lock);
    abandon(appraise);
    appraise->result = (AppraiseResult){.known = false};
    pthread_mutex_unlock(&appraise->lock);
}

void appraise_close(Appraise *appraise)
{
    if (!appraise)
        return;
    pthread_mutex_lock(&appraise->lock);
    abandon(appraise);
    appraise->ended = true;
    pthread_cond_signal(&appraise->changed);
    pthread_mutex_unlock(&appraise->lock);
    pthread_join(appraise->thread, NULL);
    destroy(appraise);
}
