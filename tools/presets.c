/* --preset NAME: sets of options. They are read before those of the command line, which override
 * them. */
#include "options.h"
#include "presets.h"

#include <string.h>

static const preset table[] = {
    {"technical", "--style gooch --edges both --lines silhouette,border,ridge,valley --width "
                  "silhouette=3.5,border=3,ridge=1.5,valley=1.5 "
                  "--color ridge=#FFFFFF,valley=#FFFFFF --inner-color #FFFFFF --surface #B8B8B8 "
                  "--highlight 0.6"},
    {"cartoon", "--style toon --lines silhouette,border,valley,intersection --width "
                "silhouette=4,border=4,valley=2,intersection=2 "
                "--surface #F2B04A"},
    {"engraving", "--style hatch --hatch-space object --lines silhouette,border,intersection "
                  "--width silhouette=2.5 "
                  "--surface #FBF6E9 --paper #FBF6E9 --hatch-color #2A2018 --color #2A2018"},
    {"blueprint", "--style paper --paper #1F3F7A --color #E8EEF8 --width "
                  "silhouette=2.5,border=2.5,ridge=1.25,valley=1.25,intersection=1.25"},
    {"sketch", "--style halftone --hatch-scale 0.6 --hatch-color #9A9A9A --edges map --edge-radius "
               "1 --inner-color #606060 --profile-color #202020"},
    {"pencil",
     "--style pencil --lines silhouette,border,valley,intersection --stroke pencil --width "
     "silhouette=3.5,border=3.5,valley=2.5,intersection=2.5 "
     "--repeats 2 --jitter 1 --overshoot 9 --taper 16 --color #303034 --hatch-color #303034"},
    {"patent", "--style paper --width silhouette=3,border=3,ridge=1.5,valley=1.5,intersection=1.5"},
};

const preset *preset_find(const char *name) {
    for (size_t k = 0; k < sizeof table / sizeof *table; k++)
        if (!strcmp(table[k].name, name)) return &table[k];
    return NULL;
}
