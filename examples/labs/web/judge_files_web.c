/* A page has no files: the picture stays in memory. */
#include "labs/web/judge_files_web.h"

#include "labs/check/judge_pictures.h"

static Image kept;

bool judge_worst(const LabPictures *pictures, int picture, const char *folder, Message *message)
{
    (void)folder;
    image_close(&kept);
    return judge_sheet(pictures, picture, &kept, message);
}

void judge_take_sheet(Image *sheet)
{
    image_close(sheet);
    *sheet = kept;
    kept = (Image){.width = 0};
}
