/* Only what is wrong is diagnosed, and from its numbers: first what is undefined, then what is
 * derived from a right program, then, without a name, which part is wrong. One derivation serves
 * all. */
#include "labs/diagnosis/diagnose.h"

#include "labs/diagnosis/derive.h"
#include "labs/diagnosis/undefined.h"

#include <stdio.h>

bool diagnose(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
              Message *message)
{
    Derivation *all = derivation_open(pictures, files, message);
    if (!all && message->text[0])
        return false;
    if (all && !undefined_explain(all, verdict))
        wrong_part_describe(all, verdict);
    derivation_close(all);
    if (!verdict->message[0])
        snprintf(verdict->message, sizeof verdict->message, "Unknown mistake");
    return true;
}
