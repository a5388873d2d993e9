/*
 * verdict_fuzz: no verdict does harm.
 *
 * The input is read as JSON; an accepted verdict, written and read again, is the same, and has what
 * pages and tables rely on: UTF-8 text without control characters, numbers in range.
 */
#include "fuzz/fuzz.h"
#include "labs/submission/verdict_fields.h"
#include "labs/submission/verdict_json.h"

#include <stdlib.h>
#include <string.h>

static void check_text(const char *text, size_t size, bool lines)
{
    require(strnlen(text, size) < size);
    for (const char *at = text; *at; at++)
        require(((unsigned char)*at >= ' ' || (lines && *at == '\n')) && *at != 0x7F);
    json_t *value = json_string(text); /* refuses what is not UTF-8 */
    require(value);
    json_decref(value);
}

static char *written(const Verdict *verdict, const char *lab)
{
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    require(file);
    JsonWriter json = {.file = file};
    json_write_object(&json, NULL);
    verdict_put(&json, verdict, lab);
    json_write_end(&json);
    require(fclose(file) == 0);
    return text;
}

FUZZ(data, size)
{
    static Verdict verdict, again;
    char lab[64], lab_again[64];
    Message message = {.text = ""};
    if (!verdict_read(data, size, lab, &verdict, &message)) {
        require(message.text[0]);
        return 0;
    }
    require(verdict.points >= 0 && verdict.points <= verdict.most &&
            verdict.kind <= VERDICT_TIMEOUT && verdict.mistake_count <= VERDICT_MAX_MISTAKES &&
            verdict.symptom_count <= VERDICT_MAX_SYMPTOMS &&
            verdict.probe_count <= VERDICT_MAX_PROBES && !strchr(verdict.picture, '/') &&
            verdict.picture[0] != '.');
    check_text(verdict.message, sizeof verdict.message, false);
    check_text(verdict.details, sizeof verdict.details, true);
    for (int i = 0; i < verdict.mistake_count; i++) {
        check_text(verdict.mistakes[i].name, sizeof verdict.mistakes[i].name, false);
        check_text(verdict.mistakes[i].look, VERDICT_SENTENCE_SIZE, false);
        check_text(verdict.mistakes[i].sentence, VERDICT_SENTENCE_SIZE, false);
    }
    for (int i = 0; i < verdict.symptom_count; i++)
        check_text(verdict.symptoms[i], VERDICT_SENTENCE_SIZE, false);
    for (int i = 0; i < verdict.probe_count; i++)
        check_text(verdict.probes[i].name, sizeof verdict.probes[i].name, false);
    char *text = written(&verdict, lab);
    require(verdict_read(text, strlen(text), lab_again, &again, &message) &&
            strcmp(lab, lab_again) == 0);
    char *text_again = written(&again, lab_again);
    require(strcmp(text, text_again) == 0);
    free(text);
    free(text_again);
    return 0;
}
