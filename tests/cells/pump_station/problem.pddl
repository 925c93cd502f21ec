; Both towers are to be full enough for the day.
(define (problem morning)
  (:domain pump-station)
  (:objects a b c - pump north south - tower a4 a8 a20 a40 - amount)
  (:init
    (serves a north) (serves b south) (serves c north) (serves c south)
    (= (level north) 20) (= (level south) 20) (= (highest north) 95) (= (highest south) 95)
    (= (sump) 80) (= (lowest) 20)
    (= (percent a4) 4) (= (percent a8) 8) (= (percent a20) 20) (= (percent a40) 40)
    (= (price a) 2) (= (price b) 2) (= (price c) 3)
    (= (energy) 0))
  (:goal (and (= (level north) 60) (= (level south) 80)))
  (:metric minimize (energy)))
