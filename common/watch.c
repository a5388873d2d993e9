#include "watch.h"

#include "progress.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

/* How long it must be quiet, in seconds, before a change is told. */
static const double SETTLE_WHOLE = 0.015; /* a file was closed, or renamed to its name */
static const double SETTLE_GONE = 0.06;   /* it is gone or being made: the next step will follow */
static const double SETTLE_MOST = 0.1;    /* since the first step, however many follow */

/* How often the paths are looked at where nothing tells of changes. */
static const double PERIOD = 0.1;

/* A name in a folder that is watched. */
typedef struct Place {
    int folder; /* as inotify numbers it */
    char *name;
} Place;

/* What tells two states of a path apart without reading it. */
typedef struct Stamp {
    int error; /* of stat; 0: the rest holds */
    dev_t device;
    ino_t inode;
    off_t size;
    struct timespec modified, changed;
} Stamp;

struct Watch {
    char **paths;
    Stamp *stamps; /* of the paths, where they are looked at */
    int path_count;
    Place *places;
    int place_count;
    int file;       /* of inotify; -1: none */
    char why[256];  /* none; empty: inotify tells everything */
    double look;    /* when to look at the paths again */
    bool due;       /* something has happened that is not told yet */
    double settled; /* when that is to be told */
    double latest;  /* and when at last */
};

static bool no_memory(Message *message)
{
    return message_set(message, "watching files: not enough memory");
}

bool watch_open(Watch **opened, Message *message)
{
    Watch *watch = calloc(1, sizeof *watch);
    *opened = watch;
    if (!watch)
        return no_memory(message);
    watch->file = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    if (watch->file < 0)
        snprintf(watch->why, sizeof watch->why, "inotify: %s", strerror(errno));
    return true;
}

static void close_paths(Watch *watch)
{
    for (int i = 0; i < watch->path_count; i++)
        free(watch->paths[i]);
    free(watch->paths);
    free(watch->stamps);
    watch->paths = NULL;
    watch->stamps = NULL;
    watch->path_count = 0;
}

static void close_places(Place *places, int count)
{
    for (int i = 0; i < count; i++)
        free(places[i].name);
    free(places);
}

static void happened(Watch *watch, double settle)
{
    const double now = progress_now();
    if (!watch->due)
        watch->latest = now + SETTLE_MOST;
    watch->due = true;
    watch->settled = fmin(now + settle, watch->latest);
}

static Stamp stamp_of(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0)
        return (Stamp){.error = errno};
    return (Stamp){.device = status.st_dev,
                   .inode = status.st_ino,
                   .size = status.st_size,
                   .modified = status.st_mtim,
                   .changed = status.st_ctim};
}

bool watch_set(Watch *watch, const char *const *paths, int count, Message *message)
{
    close_paths(watch);
    watch->paths = calloc((size_t)count + 1, sizeof *watch->paths);
    watch->stamps = calloc((size_t)count + 1, sizeof *watch->stamps);
    if (!watch->paths || !watch->stamps)
        return no_memory(message);
    for (int i = 0; i < count; i++) {
        watch->paths[i] = strdup(paths[i]);
        if (!watch->paths[i])
            return no_memory(message);
        watch->stamps[i] = stamp_of(paths[i]);
        watch->path_count++;
    }
    happened(watch, 0);
    return true;
}

/* With inotify. */

/* Whether changes can be made where this system does not see them. The numbers are those of
 * statfs(2); FUSE is also how virtual machines share folders. */
static bool is_shared(const char *folder)
{
    static const unsigned shared[] = {
        0x6969,     /* NFS */
        0x517B,     /* SMB */
        0xFE534D42, /* SMB2 */
        0xFF534D42, /* CIFS */
        0x01021997, /* 9P */
        0x65735546, /* FUSE */
        0x786F4256, /* VirtualBox */
        0x5346414F, /* AFS */
        0x00C36400, /* CEPH */
    };
    struct statfs status;
    if (statfs(folder, &status) != 0)
        return false;
    for (size_t i = 0; i < sizeof shared / sizeof shared[0]; i++)
        if ((unsigned)status.f_type == shared[i])
            return true;
    return false;
}

static bool add_place(Watch *watch, int folder, const char *name)
{
    for (int i = 0; i < watch->place_count; i++)
        if (watch->places[i].folder == folder && strcmp(watch->places[i].name, name) == 0)
            return true;
    Place *larger = realloc(watch->places, ((size_t)watch->place_count + 1) * sizeof *larger);
    if (!larger)
        return false;
    watch->places = larger;
    larger[watch->place_count].folder = folder;
    larger[watch->place_count].name = strdup(name);
    return larger[watch->place_count].name && ++watch->place_count;
}

/* Watches for a name in a folder. `last`: the folder has the file itself, or should have. */
static bool watch_name(Watch *watch, const char *folder, const char *name, bool last)
{
    const uint32_t events = IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_CREATE | IN_DELETE |
                            IN_ATTRIB | IN_ONLYDIR;
    const int number = inotify_add_watch(watch->file, folder, events);
    /* What has vanished this moment is told by the folder above it. */
    if (number < 0 && (errno == ENOENT || errno == ENOTDIR))
        return true;
    /* A folder above may be one that can be passed through, but not be looked into. */
    if (number < 0 && errno == EACCES && !last)
        return true;
    if (number < 0)
        snprintf(watch->why, sizeof watch->why, "inotify: %.150s: %s", folder, strerror(errno));
    else if (is_shared(folder))
        snprintf(watch->why, sizeof watch->why, "%.150s: on a file system that others share",
                 folder);
    else if (!add_place(watch, number, name))
        snprintf(watch->why, sizeof watch->why, "not enough memory");
    return !watch->why[0];
}

/* Where following a path has come to. */
typedef struct Way {
    char folder[PATH_MAX];
    char rest[PATH_MAX];
} Way;

/* Takes the first name off the rest. */
static bool next_name(Way *way, char name[NAME_MAX + 1])
{
    const char *start = way->rest + strspn(way->rest, "/");
    const size_t length = strcspn(start, "/");
    if (length == 0 || length > NAME_MAX)
        return false;
    memcpy(name, start, length);
    name[length] = '\0';
    memmove(way->rest, start + length, strlen(start + length) + 1);
    return true;
}

/* Goes on in the folder `path`, or where the link `path` leads. False where there is no way on. */
static bool follow(Way *way, const char *path)
{
    struct stat status;
    char target[PATH_MAX], joined[2 * PATH_MAX];
    if (lstat(path, &status) != 0)
        return false;
    if (S_ISDIR(status.st_mode))
        return snprintf(way->folder, PATH_MAX, "%s", path) < PATH_MAX;
    if (!S_ISLNK(status.st_mode))
        return false;
    const ssize_t length = readlink(path, target, sizeof target - 1);
    if (length <= 0)
        return false;
    target[length] = '\0';
    if (target[0] == '/')
        snprintf(way->folder, PATH_MAX, "/");
    if (snprintf(joined, sizeof joined, "%s/%s", target, way->rest) >= PATH_MAX)
        return false;
    memcpy(way->rest, joined, strlen(joined) + 1);
    return true;
}

/* Watches for every name on the way to a path, as far as there is a way. Each folder is watched
 * before it is looked into, so that no change falls between. */
static void watch_path(Watch *watch, const char *path)
{
    enum { MOST_STEPS = 1000 }; /* links can lead in circles */
    Way way;
    char name[NAME_MAX + 1], next[PATH_MAX + NAME_MAX + 2];
    snprintf(way.folder, sizeof way.folder, "%s", path[0] == '/' ? "/" : ".");
    if (snprintf(way.rest, sizeof way.rest, "%s", path) >= PATH_MAX)
        return; /* no file has such a name */
    for (int i = 0; i < MOST_STEPS && next_name(&way, name); i++) {
        const bool last = !way.rest[strspn(way.rest, "/")];
        if (!watch_name(watch, way.folder, name, last))
            break;
        snprintf(next, sizeof next, "%s/%s", strcmp(way.folder, "/") == 0 ? "" : way.folder, name);
        if (strlen(next) >= PATH_MAX || !follow(&way, next))
            break;
    }
}

static bool is_watched(const Place *places, int count, int folder)
{
    for (int i = 0; i < count; i++)
        if (places[i].folder == folder)
            return true;
    return false;
}

/* Watches what is on the way to the paths now, and nothing else. */
static void watch_again(Watch *watch)
{
    Place *before = watch->places;
    const int count = watch->place_count;
    watch->places = NULL;
    watch->place_count = 0;
    for (int i = 0; i < watch->path_count && !watch->why[0]; i++)
        watch_path(watch, watch->paths[i]);
    for (int i = 0; i < count; i++)
        if (!is_watched(before, i, before[i].folder) &&
            !is_watched(watch->places, watch->place_count, before[i].folder))
            inotify_rm_watch(watch->file, before[i].folder);
    close_places(before, count);
    if (watch->why[0]) {
        close(watch->file);
        watch->file = -1;
    }
}

static bool concerns(const Watch *watch, const struct inotify_event *event)
{
    if (event->mask & IN_Q_OVERFLOW)
        return true;
    const bool folder_gone = event->mask & (IN_IGNORED | IN_UNMOUNT);
    for (int i = 0; i < watch->place_count; i++)
        if (watch->places[i].folder == event->wd &&
            (folder_gone || (event->len && strcmp(watch->places[i].name, event->name) == 0)))
            return true;
    return false;
}

static void read_events(Watch *watch)
{
    char buffer[16384] __attribute__((aligned(__alignof__(struct inotify_event))));
    ssize_t size;
    while ((size = read(watch->file, buffer, sizeof buffer)) > 0) {
        for (const char *p = buffer; p < buffer + size;) {
            const struct inotify_event *event = (const void *)p;
            const bool whole = event->mask & (IN_CLOSE_WRITE | IN_MOVED_TO | IN_ATTRIB);
            if (concerns(watch, event))
                happened(watch, whole ? SETTLE_WHOLE : SETTLE_GONE);
            p += sizeof *event + event->len;
        }
    }
}

/* Without it. */

static bool time_equal(struct timespec a, struct timespec b)
{
    return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

static bool stamp_equal(const Stamp *a, const Stamp *b)
{
    return a->error == b->error && a->device == b->device && a->inode == b->inode &&
           a->size == b->size && time_equal(a->modified, b->modified) &&
           time_equal(a->changed, b->changed);
}

static void look(Watch *watch)
{
    for (int i = 0; i < watch->path_count; i++) {
        const Stamp now = stamp_of(watch->paths[i]);
        if (!stamp_equal(&now, &watch->stamps[i]))
            happened(watch, now.error ? SETTLE_GONE : SETTLE_WHOLE);
        watch->stamps[i] = now;
    }
    watch->look = progress_now() + PERIOD;
}

bool watch_changed(Watch *watch)
{
    if (!watch->why[0])
        read_events(watch);
    else if (progress_now() >= watch->look || (watch->due && progress_now() >= watch->settled))
        look(watch);
    if (!watch->due || progress_now() < watch->settled)
        return false;
    if (!watch->why[0])
        watch_again(watch);
    watch->due = false;
    return true;
}

/* How long until there is something to do, in milliseconds; -1: only when something happens. */
static int patience(const Watch *watch, double until)
{
    double next = until;
    if (watch->due)
        next = fmin(next, watch->settled);
    if (watch->why[0])
        next = fmin(next, watch->look);
    if (next == HUGE_VAL)
        return -1;
    return (int)ceil(1e3 * fmin(fmax(next - progress_now(), 0), 1000));
}

bool watch_wait(Watch *watch, double seconds)
{
    const double until = progress_now() + seconds;
    for (;;) {
        if (watch_changed(watch))
            return true;
        if (progress_now() >= until)
            return false;
        struct pollfd ready = {.fd = watch->file, .events = POLLIN}; /* -1: none */
        poll(&ready, 1, patience(watch, until));
    }
}

const char *watch_polls(const Watch *watch)
{
    return watch->why[0] ? watch->why : NULL;
}

void watch_close(Watch *watch)
{
    if (!watch)
        return;
    close_paths(watch);
    close_places(watch->places, watch->place_count);
    if (watch->file >= 0)
        close(watch->file);
    free(watch);
}
