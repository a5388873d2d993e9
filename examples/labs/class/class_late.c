/* Moodle's and Canvas's archives give all files the time of the download (Moodle's zip_writer adds
 * streams without a time, as Canvas's ContentZipper does); only Canvas's names say who is late. */
#include "labs/class/class_find.h"

#include "base/input.h"
#include "labs/submission/lab_json.h"

#include <fcntl.h>
#include <ftw.h>
#include <stdlib.h>
#include <string.h>

static long long newest; /* of the files that nftw visits */

static int visit(const char *path, const struct stat *status, int type, struct FTW *at)
{
    if (type == FTW_F && path[at->base] != '.' && status->st_mtime > newest)
        newest = status->st_mtime;
    return 0;
}

static int days_after(long long due, long long when)
{
    const long long day = 24 * 60 * 60;
    return due && when > due ? (int)((when - due - 1) / day) + 1 : 0;
}

/* "Li,2", "4711,2026-11-21 08:00". */
static bool read_line(FoundList *list, const Lab *lab, char *line, Message *message)
{
    char *comma = strrchr(line, ','), *end = comma;
    long long time;
    bool found = false;
    long days = comma ? strtol(comma + 1, &end, 10) : 0;
    if (comma && lab->points.due && lab_time_read(comma + 1, &time))
        days = days_after(lab->points.due, time);
    else if (!comma || end == comma + 1 || end[strspn(end, " \r")] || days < 0 || days > 10000)
        return message_set(message, "must be a student's name or number, a comma, and days late "
                                    "or, if lab.json has \"due\", like 2026-11-21 08:00");
    *comma = '\0';
    for (int i = 0; i < list->count; i++) {
        Found *of = &list->items[i];
        if (strcmp(of->name.student, line) != 0 && strcmp(of->name.id, line) != 0)
            continue;
        of->days_late = (int)days;
        found = true;
    }
    return found || message_set(message, "\"%.80s\": no submission has this name or number", line);
}

static bool read_table(FoundList *list, const Lab *lab, const char *path, Message *message)
{
    size_t size;
    Message why = {.text = ""};
    char *text = input_read(AT_FDCWD, path, path, 1 << 20, &size, message), *rest = text, *line;
    bool done = text != NULL;
    for (int number = 1; done && (line = strsep(&rest, "\n")) != NULL; number++)
        done = !line[0] || read_line(list, lab, line, &why) ||
               message_set(message, "%s:%d: %s", path, number, why.text);
    free(text);
    return done;
}

bool class_late_find(FoundList *list, const Lab *lab, const char *table, Message *notes,
                     Message *message)
{
    bool untold = false;
    if (lab->points.day_count == 0)
        return !table || message_set(message, "--late: lab.json of %s has no \"late\"", lab->name);
    for (int i = 0; i < list->count; i++) {
        Found *found = &list->items[i];
        newest = 0;
        nftw(found->path, visit, 8, FTW_PHYS);
        for (int k = 0; k < found->count; k++)
            nftw(found->files[k].path, visit, 8, FTW_PHYS);
        found->days_late =
            found->name.of_platform ? found->name.late : days_after(lab->points.due, newest);
        untold |= found->name.of_platform;
    }
    if (untold && !table)
        message_add(notes,
                    "%sthe platform's archive does not say when a file came: nobody is late "
                    "but who is in its names, by a day; --late FILE says more",
                    notes->text[0] ? "\n" : "");
    return !table || read_table(list, lab, table, message);
}
