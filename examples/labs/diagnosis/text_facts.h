/*
 * text_facts: what the texts of a submission tell without being drawn.
 */
#ifndef TEXT_FACTS_H
#define TEXT_FACTS_H

#include "labs/submission/submission.h"
#include "labs/submission/verdict.h"

/* Whether two texts are the same except for comments and white space. */
bool text_is_same(const char *a, const char *b);

/* Whether a lab's files are the starter's, except for comments and white space. */
bool text_is_starter(const Lab *lab, const SubmissionFiles *files);

/* Whether one of the files has the word, comments aside. */
bool text_has_word(const SubmissionFiles *files, const char *word);

#endif
