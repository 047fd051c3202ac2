/* --preset NAME: sets of options. They are read before those of the command line, which override
 * them. */
#include "options.h"
#include "presets.h"

#include <string.h>

static const preset table[] = {
    /* As a drawing office draws: three weights, and what is hidden dashed. */
    {"technical", "--style paper --color black --hidden dashed --hidden-width 0.09% --width "
                  "silhouette=0.3%,border=0.3%,ridge=0.15%,valley=0.15%,intersection=0.15%"},
    /* Gooch et al. 1998: outlines black, creases white, surfaces from cool to warm. */
    {"illustration", "--style gooch --edges both --lines "
                     "silhouette,border,ridge,valley,section,hatching --width "
                     "silhouette=0.5%,border=0.4%,ridge=0.2%,valley=0.2% "
                     "--color ridge=white,valley=white --inner-color white --surface #B8B8B8 "
                     "--highlight 0.6"},
    {"cartoon",
     "--style toon --lines silhouette,border,valley,intersection,section,hatching --width "
     "silhouette=0.6%,border=0.6%,valley=0.3%,intersection=0.3% "
     "--surface #F2B04A"},
    {"engraving",
     "--style hatch --hatch-space object --lines silhouette,border,intersection,section,hatching "
     "--width silhouette=0.4%,border=0.4%,intersection=0.3% "
     "--surface #FBF6E9 --paper #FBF6E9 --hatch-color #2A2018 --color #2A2018"},
    {"blueprint", "--style paper --paper #1F3F7A --color #E8EEF8 --width "
                  "silhouette=0.35%,border=0.35%,ridge=0.175%,valley=0.175%,intersection=0.175%"},
    {"sketch", "--style halftone --hatch-scale 0.6 --hatch-color #9A9A9A --edges map --edge-radius "
               "1 --inner-color #606060 --profile-color #202020"},
    {"pencil",
     "--style pencil --lines silhouette,border,valley,intersection,section,hatching "
     "--stroke pencil --width "
     "silhouette=3.5,border=3.5,valley=2.5,intersection=2.5 "
     "--repeats 2 --jitter 1 --overshoot 9 --taper 16 --color #303034 --hatch-color #303034"},
    {"patent", "--style paper --width "
               "silhouette=0.35%,border=0.35%,ridge=0.175%,valley=0.175%,intersection=0.175%"},

    /* ISO 128-2, line group 0.5: visible outlines and edges 0.5 mm, hidden ones 0.25 mm and dashed,
     * 12 widths drawn and 3 not, which is what `dashed` means. */
    {"iso", "--page A4 --ortho 0 --style paper --color #000000 --width 0.5mm --hidden dashed "
            "--hidden-width 0.25mm"},
    /* 37 CFR 1.84 (g): top and left at least 1 inch, right 5/8, bottom 3/8; black lines. */
    {"patent-us",
     "--page letter-portrait --margin 25.4,15.9,9.6,25.4 --style paper --color #000000 "
     "--width silhouette=0.5mm,border=0.5mm,ridge=0.3mm,valley=0.3mm,"
     "intersection=0.3mm --hidden none"},
    /* EPC, Rule 46: top and left 25 mm, right 15, bottom 10; black lines of even thickness. */
    {"patent-epc", "--page A4-portrait --margin 25,15,10,25 --style paper --color #000000 "
                   "--width 0.4mm --hidden none"},
    /* One pen, nothing twice, little travel. */
    {"axidraw", "--page A4 --style paper --color #000000 --width 0.5mm --hidden none --optimize"},
    /* Lasers take what is at most 0.001 inch wide for a path to follow, and colours for what to do
     * with it. At 600 dpi that is more than the half pixel that a line has at least. */
    {"laser",
     "--scale 1:1 --dpi 600 --samples 1 --style paper --width 0.025mm --hidden none --color "
     "silhouette=#FF0000,border=#FF00FF,ridge=#0000FF,valley=#00C000,"
     "intersection=#00C0C0,section=#FF8000,hatching=#808000"},
};

const preset *preset_find(const char *name) {
    for (size_t k = 0; k < sizeof table / sizeof *table; k++)
        if (!strcmp(table[k].name, name)) return &table[k];
    return NULL;
}
