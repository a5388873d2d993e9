/*
 * One pass over the text, by recursive descent: what is between two tags is copied, and a section's
 * body is passed over once for each repetition, or once without output if it has none, which finds
 * its end and its mistakes. The syntax is a part of Mustache's (mustache(5)).
 */
#include "base/template.h"

#include "base/input.h"
#include "base/memory.h"
#include "base/output_text.h"
#include "base/paths.h"

#include <limits.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* A text or, if that is NULL, a repetition of a section. */
typedef struct Value {
    const char *name;
    char *text;
    TemplateValues *section;
    struct Value *next;
} Value;

struct TemplateValues {
    const TemplateValues *around;
    Value *first, **last;
};

TemplateValues *template_values(void)
{
    TemplateValues *values = memory_new(1, sizeof *values);
    values->last = &values->first;
    return values;
}

static Value *append(TemplateValues *values, const char *name)
{
    Value *value = memory_new(1, sizeof *value);
    value->name = name;
    *values->last = value;
    values->last = &value->next;
    return value;
}

void template_set(TemplateValues *values, const char *name, const char *format, ...)
{
    va_list list, again;
    va_start(list, format);
    va_copy(again, list);
    const size_t size = (size_t)vsnprintf(NULL, 0, format, list) + 1;
    Value *value = append(values, name);
    value->text = memory_new(size, 1);
    vsnprintf(value->text, size, format, again);
    va_end(again);
    va_end(list);
}

TemplateValues *template_add(TemplateValues *values, const char *section)
{
    TemplateValues *added = append(values, section)->section = template_values();
    added->around = values;
    return added;
}

void template_close(TemplateValues *values)
{
    for (Value *value = values ? values->first : NULL, *next; value; value = next) {
        next = value->next;
        template_close(value->section);
        free(value->text);
        free(value);
    }
    free(values);
}

/* Of this name from `value` on. */
static const Value *find(const Value *value, const char *name)
{
    while (value && strcmp(value->name, name) != 0)
        value = value->next;
    return value;
}

typedef struct Filling {
    const char *file, *text;
    FILE *out;
    Message *message;
} Filling;

/* Returns NULL. */
static const char *broken(const Filling *filling, const char *at, const char *name, const char *why)
{
    int line = 1;
    for (const char *p = filling->text; p < at; p++)
        line += *p == '\n';
    message_set(filling->message, "%s:%d: {{%s}}: %s", filling->file, line, name, why);
    if (filling->message)
        filling->message->located = true;
    return NULL;
}

static void put_escaped(FILE *out, const char *text)
{
    static const char special[] = "&<>\"'";
    static const char *const names[] = {"amp", "lt", "gt", "quot", "#39"};
    for (; *text; text++) {
        const char *at = strchr(special, *text);
        if (at)
            fprintf(out, "&%s;", names[at - special]);
        else if ((unsigned char)*text >= ' ' || *text == '\n' || *text == '\t')
            fputc(*text, out); /* XML allows no other control characters */
    }
}

/* Writes a value, as it is or escaped; false: there is none. */
static bool put_value(FILE *out, const TemplateValues *values, const char *name, bool raw)
{
    for (; values; values = values->around) {
        const Value *value = find(values->first, name);
        if (!value || !value->text)
            continue;
        if (raw)
            fputs(value->text, out);
        else
            put_escaped(out, value->text);
        return true;
    }
    return false;
}

typedef struct Tag {
    const char *start, *end; /* with its whole line, if it is alone there and writes nothing */
    char kind;               /* one of "#^/!&", or '\0': a value */
    char name[40];
} Tag;

static bool is_blank(const char *from, const char *to)
{
    while (from < to && (*from == ' ' || *from == '\t'))
        from++;
    return from == to;
}

static void take_line(const Filling *filling, Tag *tag)
{
    const char *start = tag->start, *end = tag->end + strcspn(tag->end, "\n");
    while (start > filling->text && start[-1] != '\n')
        start--;
    if (!is_blank(start, tag->start) || !is_blank(tag->end, end))
        return;
    tag->start = start;
    tag->end = end + (*end == '\n');
}

/* Reads the tag at "{{". */
static bool read_tag(const Filling *filling, const char *at, Tag *tag)
{
    const char *name = at + 2, *end = name + strcspn(name, "}\n");
    *tag = (Tag){.start = at, .end = end + 2, .kind = strchr("#^/!&", *name) ? *name : '\0'};
    name += tag->kind != '\0';
    snprintf(tag->name, sizeof tag->name, "%.*s", (int)(end - name), name);
    if (strncmp(end, "}}", 2) != 0)
        return broken(filling, at, tag->name, "is not closed in its line");
    if (tag->kind != '\0' && tag->kind != '&')
        take_line(filling, tag);
    return true;
}

static const char *fill(const Filling *filling, const char *from, const TemplateValues *values,
                        const char *section, bool shown);

/* From a section's first tag to its last; returns what follows. */
static const char *fill_section(const Filling *filling, const Tag *tag,
                                const TemplateValues *values, bool shown)
{
    const char *end = NULL;
    const Value *value = find(values->first, tag->name);
    if (value && value->text && !value->text[0])
        value = NULL;
    if (tag->kind == '^' || !value)
        return fill(filling, tag->end, values, tag->name, shown && (tag->kind == '^') == !value);
    for (; value; value = find(value->next, tag->name)) {
        end = fill(filling, tag->end, value->text ? values : value->section, tag->name, shown);
        if (!end)
            return NULL;
    }
    return end;
}

/* Up to the end of a section, or of the text if that is NULL; returns what follows, or NULL. */
static const char *fill(const Filling *filling, const char *from, const TemplateValues *values,
                        const char *section, bool shown)
{
    for (const char *at; (at = strstr(from, "{{"));) {
        Tag tag;
        if (!read_tag(filling, at, &tag))
            return NULL;
        if (shown && tag.start > from)
            fwrite(from, 1, (size_t)(tag.start - from), filling->out);
        from = tag.end;
        if (tag.kind == '/')
            return section && strcmp(section, tag.name) == 0
                       ? from
                       : broken(filling, at, tag.name, "closes a section that is not open");
        if (tag.kind == '#' || tag.kind == '^')
            from = fill_section(filling, &tag, values, shown);
        else if (tag.kind != '!' && shown &&
                 !put_value(filling->out, values, tag.name, tag.kind == '&'))
            return broken(filling, at, tag.name, "has no value here");
        if (!from)
            return NULL;
    }
    if (section)
        return broken(filling, from + strlen(from), section, "is not closed");
    fputs(from, filling->out);
    return from;
}

bool template_fill(const char *file, const char *text, const TemplateValues *values, FILE *out,
                   Message *message)
{
    const Filling filling = {file, text, out, message};
    return fill(&filling, text, values, NULL, true);
}

bool template_print(const char *source, const TemplateValues *values, FILE *out, Message *message)
{
    const char *name = strrchr(source, '/') + 1;
    char installed[NAME_MAX], found[PATH_MAX];
    snprintf(installed, sizeof installed, "templates/%s", name);
    paths_find_data(source, installed, found);
    Message why = {0};
    size_t size;
    char *text = input_whole(found, &size, &why);
    const bool done =
        text ? template_fill(found, text, values, out, message)
             : message_set(message, "%s: cannot read the template: %s", found, why.text);
    free(text);
    return done;
}

bool template_write(const char *source, const TemplateValues *values, const char *path,
                    Message *message)
{
    OutputText filled;
    output_text_open(&filled);
    if (template_print(source, values, filled.file, message))
        return output_text_write(&filled, path, message);
    free(output_text_close(&filled));
    return false;
}
