incognita_room(models USES incognita::math)
