/*
 * A picture is drawn, then encoded, which takes up to twice as long: so two threads encode while
 * the next is drawn. Pictures are a fixed number of slots that go round: one for each thread, one
 * being drawn, and one that waits to even out their times. A slot is free, taken (drawn into),
 * waiting or being written; one lock guards the states, and whoever changes one wakes all others.
 * Each picture has its turn in the order in which it was given, so that with a single writer, which
 * an animation has, they arrive in order. After a failure the others are taken and dropped, so that
 * nobody waits for a writer that has ended.
 */
#include "images/picture_queue.h"

#include "base/memory.h"
#include "base/version.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_WRITERS = 2, MAX_SLOTS = MAX_WRITERS + 2 };

typedef enum SlotState { SLOT_FREE, SLOT_TAKEN, SLOT_WAITING, SLOT_WRITING } SlotState;

struct PictureQueue {
    PictureWrite *write;
    void *data;
    pthread_t writers[MAX_WRITERS];
    int writer_count;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    int slots;
    Picture pictures[MAX_SLOTS];
    SlotState states[MAX_SLOTS];
    unsigned long order[MAX_SLOTS]; /* in which they were given and are written */
    unsigned long given;
    bool ended;
    bool failed;
    Message failure; /* of the first picture that could not be written */
};

bool picture_write(const Picture *picture, Message *message)
{
    ImageText text[7] = {
        {"Title", picture->title},
        {"Software", "lighting " VERSION},
        {"Time", picture->moment},
        {"Driver", picture->driver},
    };
    ImageText *last = text + 4;
    if (picture->command[0])
        *last++ = (ImageText){"Command", picture->command};
    if (picture->sources[0])
        *last = (ImageText){"Sources", picture->sources};
    const ImageOptions options = {
        .compress = picture->compress, .alpha = picture->alpha, .text = text};
    return image_write(&picture->image, picture->path, &options, message);
}

static bool write_file(void *data, const Picture *picture, Message *message)
{
    (void)data;
    return picture_write(picture, message);
}

/* The slot in `state` given first, or -1. */
static int oldest(const PictureQueue *queue, SlotState state)
{
    int found = -1;
    for (int i = 0; i < queue->slots; i++)
        if (queue->states[i] == state && (found < 0 || queue->order[i] < queue->order[found]))
            found = i;
    return found;
}

static void *write_pictures(void *argument)
{
    PictureQueue *queue = argument;
    pthread_mutex_lock(&queue->lock);
    for (;;) {
        const int slot = oldest(queue, SLOT_WAITING);
        if (slot < 0 && queue->ended)
            break;
        if (slot < 0) {
            pthread_cond_wait(&queue->changed, &queue->lock);
            continue;
        }
        queue->states[slot] = SLOT_WRITING;
        if (!queue->failed) {
            Message message = {0};
            pthread_mutex_unlock(&queue->lock);
            const bool written = queue->write(queue->data, &queue->pictures[slot], &message);
            pthread_mutex_lock(&queue->lock);
            if (!written && !queue->failed) {
                queue->failed = true;
                queue->failure = message;
            }
        }
        queue->states[slot] = SLOT_FREE;
        pthread_cond_broadcast(&queue->changed);
    }
    pthread_mutex_unlock(&queue->lock);
    return NULL;
}

static void free_queue(PictureQueue *queue)
{
    for (int i = 0; i < queue->slots; i++)
        image_close(&queue->pictures[i].image);
    pthread_cond_destroy(&queue->changed);
    pthread_mutex_destroy(&queue->lock);
    free(queue);
}

bool picture_queue_open(PictureQueue **opened, const PictureQueueOptions *options, Message *message)
{
    PictureQueue *queue = memory_new(1, sizeof *queue);
    const int threads = options->write ? 1 : MAX_WRITERS;
    *opened = NULL;
    queue->write = options->write ? options->write : write_file;
    queue->data = options->data;
    queue->slots = options->count < MAX_SLOTS ? options->count : MAX_SLOTS;
    pthread_mutex_init(&queue->lock, NULL);
    pthread_cond_init(&queue->changed, NULL);
    for (int i = 0; i < queue->slots; i++) {
        if (!image_open(&queue->pictures[i].image, options->width, options->height, options->type,
                        message)) {
            free_queue(queue);
            return false;
        }
    }
    int error = 0;
    for (int i = 0; i < threads && i < queue->slots && !error; i++) {
        error = pthread_create(&queue->writers[i], NULL, write_pictures, queue);
        queue->writer_count += !error;
    }
    if (!queue->writer_count) {
        free_queue(queue);
        return message_set(message, "pictures: cannot start a thread: %s", strerror(error));
    }
    *opened = queue;
    return true;
}

Picture *picture_queue_take(PictureQueue *queue)
{
    int slot;
    pthread_mutex_lock(&queue->lock);
    while ((slot = oldest(queue, SLOT_FREE)) < 0)
        pthread_cond_wait(&queue->changed, &queue->lock);
    queue->states[slot] = SLOT_TAKEN;
    pthread_mutex_unlock(&queue->lock);
    return &queue->pictures[slot];
}

bool picture_queue_give(PictureQueue *queue, Picture *picture, Message *message)
{
    const size_t slot = (size_t)(picture - queue->pictures);
    pthread_mutex_lock(&queue->lock);
    queue->states[slot] = SLOT_WAITING;
    queue->order[slot] = queue->given++;
    const bool written = !queue->failed;
    if (!written)
        message_set(message, "%s", queue->failure.text);
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
    return written;
}

bool picture_queue_close(PictureQueue *queue, Message *message)
{
    if (!queue)
        return true;
    pthread_mutex_lock(&queue->lock);
    queue->ended = true;
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
    for (int i = 0; i < queue->writer_count; i++)
        pthread_join(queue->writers[i], NULL);
    const bool written = !queue->failed;
    if (!written)
        message_set(message, "%s", queue->failure.text);
    free_queue(queue);
    return written;
}
