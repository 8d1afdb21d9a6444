/* Keys: none is ever pressed while the program does not wait for one, and one that it waits for comes from stdin. */
#ifndef DRYCUT_CONIO_H
#define DRYCUT_CONIO_H

#include <stdio.h>

static inline int _kbhit(void) { return 0; }
static inline int kbhit(void) { return 0; }
static inline int _getch(void) { return getchar(); }
static inline int getch(void) { return getchar(); }
static inline int _getche(void) { return getchar(); }

#endif
