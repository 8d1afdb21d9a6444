// The sheet of answers in the language of who reads it.
import * as language from "../../html/assets/language.js";

language.begin();
