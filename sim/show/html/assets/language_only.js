// A page without other scripts, in the language of who reads it.
import * as language from "./language.js";

language.begin();
