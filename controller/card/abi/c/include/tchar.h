/* Texts of Windows, as plain char. */
#ifndef DRYCUT_TCHAR_H
#define DRYCUT_TCHAR_H

#include <stdio.h>
#include <string.h>

typedef char TCHAR;
typedef char _TCHAR;
#define _T(text) text
#define TEXT(text) text
#define _tmain main
#define _tprintf printf
#define _tcslen strlen
#define _tcscmp strcmp
#define _tcscpy strcpy

#endif
